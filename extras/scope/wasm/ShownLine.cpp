#include "ShownLine.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "line/Silence.h"

namespace scope {

ShownLine shownLine;
alignas(8) uint8_t transfer[TransferSize];

namespace {

uint8_t flagsOf(const line::Observer &observer) {
  const line::Values &newest = observer.newest();
  return static_cast<uint8_t>(
      (newest.switches[0] ? sbus::FlagChannel17 : 0) | (newest.switches[1] ? sbus::FlagChannel18 : 0) |
      (newest.lostFrame ? sbus::FlagLostFrame : 0) | (observer.inFailsafe() ? sbus::FlagFailsafe : 0) |
      (observer.inFailsafe() && !newest.failsafe ? FlagByLosses : 0) | (newest.hasNoPulses() ? FlagNoPulses : 0));
}

}  // namespace

size_t readingOf(const line::Quantity &quantity) {
  const bool isSecond = quantity.slot == 0 && std::string_view(quantity.name) == "external voltage";
  return isSecond ? Record::ReadingsMax - 1 : quantity.slot;
}

ShownLine::ShownLine() {
  observer.listen([this](const line::Stretch &stretch) { take(stretch); });
}

void ShownLine::reset(uint64_t nowUs, const line::LineSettings &now) {
  settings = now;
  records.clear();
  _lately.clear();
  _newest.reset();
  rows = BoardRows();
  _damage = Damage();
  readings = line::Readings(sensors);
  _finished = false;
  observer.reset(nowUs, settings.characterUs());
  _reads = line::PortReads(settings.characterUs());
  _reads.empty(nowUs);
  _stalled = StalledReads();
  _lateReads = 0;
  _lateUs = 0;
  _characterUs = 0;
  _turnUs = nowUs;
  _lookUs = nowUs;
  mark();
}

void ShownLine::mark() {
  examination.begin(observer, _turnUs);
  verdict.begin(observer, _turnUs);
}

void ShownLine::received(const uint8_t *bytes, size_t count, uint64_t nowUs) {
  _stalled.put(bytes, count, nowUs);
  takeReads(nowUs);
}

void ShownLine::takeReads(uint64_t nowUs) {
  if (!_stalled.isHolding() || _stalled.waits(nowUs)) {
    return;
  }
  const std::vector<uint8_t> bytes = _stalled.take();
  if (_stalled.isStall()) {
    _reads.beginHeld(bytes.size(), _stalled.quietUs(), _stalled.stepUs(), nowUs);
  } else {
    _reads.begin(bytes.size(), nowUs, line::PortReads::UsualLatencyUs);
  }
  uint64_t toComeUs = bytes.size() * settings.characterUs();
  for (const uint8_t byte : bytes) {
    const line::Character character = _reads.next(byte);
    toComeUs -= settings.characterUs();
    put(character, _stalled.isStall() ? nowUs - toComeUs : character.endUs);  // a recording has the times of the reads
    if (rows.put(byte, nowUs)) {
      takeRow(nowUs, character.lateUs);
    }
  }
}

void ShownLine::receivedBad(uint64_t nowUs) {
  _reads.begin(1, nowUs, line::PortReads::UsualLatencyUs);
  const line::Character character = _reads.next(0, true);
  put(character, character.endUs);
}

void ShownLine::put(const line::Character &character, uint64_t readUs) {
  if (_isRecording) {  // the characters of a read may have been on the line a little before
    line::Character recorded = character;
    recorded.endUs = std::max(readUs, _recordedUs + settings.characterUs());
    recorder.put(recorded);
  }
  observer.put(character);
  _characterUs = character.endUs;
  _lateReads += character.lateUs >= line::SilenceUs && character.lateUs != _lateUs;
  _lateUs = character.lateUs;
}

void ShownLine::record(bool on) {
  if (on) {
    _recordedUs = _turnUs;
    recorder = line::RecordingWriter();
    recorder.setZero(-static_cast<int64_t>(_turnUs));
    recorder.opened(settings);
  } else if (_isRecording) {
    recorder.finish();
  }
  _isRecording = on;
}

void ShownLine::advance(uint64_t nowUs) {
  line::Line *const line = simulated ? static_cast<line::Line *>(simulated.get()) : played.get();
  line::Character character;
  while (line != nullptr && records.size() < Enough && line->next(nowUs, character)) {
    verdict.until(observer, settings, character.endUs);
    put(character, character.endUs);
    if (played && rows.put(character)) {  // a board's port was recorded
      takeRow(character.endUs, character.lateUs);
    }
  }
  if (played && played->needsMore()) {
    return;
  }
  takeReads(nowUs);
  if (nowUs >= _lookUs + LookUs &&
      !_stalled.isHolding()) {  // the browser has handed over all that had come by the last look
    _reads.empty(_lookUs);
    _lookUs = nowUs;
  }
  _turnUs = std::max(_turnUs, nowUs);
  const uint64_t onItsWayUs = 2 * settings.characterUs();  // a character that is not known yet
  if (records.size() < Enough && nowUs > onItsWayUs) {
    observer.idleUntil(line != nullptr ? line->knownUs(nowUs - onItsWayUs) : _reads.knownUs());
  }
  if (played && played->atEnd() && !_finished && nowUs >= _characterUs + EndUs) {
    _finished = true;
    observer.finish();
  }
  if (records.size() < Enough) {
    verdict.until(observer, settings, nowUs);
    const uint64_t us = knownUs(nowUs);
    if (happens(us)) {
      Record record{};
      record.endUs = static_cast<double>(us);
      record.kind = static_cast<uint8_t>(Kind::Silence);
      record.flags = FlagEvent;
      records.push_back(record);
    }
  }
}

void ShownLine::watchFor(std::optional<line::Condition> condition) {
  _condition = std::move(condition);
  happens(knownUs(_turnUs));  // not now: it is true already
}

// Returns true if the condition becomes true.
bool ShownLine::happens(uint64_t nowUs) {
  if (!_condition) {
    return false;
  }
  line::Moment moment(observer, nowUs, _isRejected);
  if (rows.recognised() && _newest) {
    moment.setChannels(_newest->channels, _newest->channelCount);
    moment.values[line::Moment::Age] = static_cast<double>(rows.ageUs(nowUs));
    moment.values[line::Moment::State] = static_cast<double>(state(nowUs));
    moment.values[line::Moment::Failsafe] = rows.failsafe();
    moment.values[line::Moment::NoPulses] = 0;
    moment.values[line::Moment::Jump] = 0;
    moment.values[line::Moment::LostFrame] = rows.lostFrame();
  }
  const bool before = std::exchange(_holds, _condition->holds(moment));
  return _holds && !before;
}

// A port is read some milliseconds late: only what was later shows in the line's state.
uint64_t ShownLine::knownUs(uint64_t nowUs) const {
  const uint64_t us = simulated ? nowUs : played ? played->knownUs(nowUs) : _reads.emptyUs();
  return us + line::SilenceUs <= nowUs ? us : nowUs;
}

void ShownLine::takeRow(uint64_t nowUs, uint64_t lateUs) {
  Record record{};
  record.endUs = static_cast<double>(nowUs);
  record.lateUs = static_cast<double>(lateUs);
  record.kind = static_cast<uint8_t>(Kind::Row);
  record.flags =
      static_cast<uint8_t>((rows.lostFrame() ? sbus::FlagLostFrame : 0) | (rows.failsafe() ? sbus::FlagFailsafe : 0));
  for (size_t i = 0; i < rows.row().size(); i++) {
    const double value = rows.row()[i].value;
    const line::CsvKind kind = rows.kind(i);
    if (kind == line::CsvKind::Channel && record.channelCount < Record::ChannelsMax) {
      record.channels[record.channelCount++] = value;
    }
    const uint8_t flag = kind == line::CsvKind::Switch17   ? sbus::FlagChannel17
                         : kind == line::CsvKind::Switch18 ? sbus::FlagChannel18
                                                           : 0;
    const uint8_t has = flag != 0 ? FlagHasSwitches : kind != line::CsvKind::Channel ? FlagHasFlags : 0;
    record.flags = static_cast<uint8_t>(record.flags | has | (value != 0 ? flag : 0));
  }
  add(record);
}

void ShownLine::add(const Record &record) {
  records.push_back(record);
  records.back().state = static_cast<uint8_t>(state(static_cast<uint64_t>(record.endUs)));
  _lately.push_back(records.back());
  if (_lately.size() > Shown) {
    _lately.pop_front();
  }
  if (record.kind != static_cast<uint8_t>(line::Stretch::Kind::NoFrame)) {
    _newest = records.back();
  }
  if (happens(static_cast<uint64_t>(record.endUs))) {
    records.back().flags |= FlagEvent;
  }
}

void ShownLine::recall() {
  records.assign(_lately.begin(), _lately.end());
  if (_newest && (records.empty() || _newest->endUs < records.front().endUs)) {
    records.insert(records.begin(), *_newest);
  }
}

void ShownLine::take(const line::Stretch &stretch) {
  const line::Values &newest = observer.newest();
  Record record{};
  record.endUs = static_cast<double>(stretch.endUs());
  record.beginUs = static_cast<double>(stretch.characters.front().endUs) - settings.characterUs();
  record.lateUs = static_cast<double>(stretch.lateUs());
  record.damagedUs = static_cast<double>(_damage.take(stretch, !observer.telemetry().proved().empty()));
  record.kind = static_cast<uint8_t>(stretch.kind);
  record.flags = flagsOf(observer);
  record.channelCount = static_cast<uint8_t>(newest.count);
  std::copy_n(newest.raw.begin(), newest.raw.size(), record.channels);
  record.size = static_cast<uint8_t>(std::min(stretch.characters.size(), Record::BytesMax));
  std::transform(stretch.characters.begin(), stretch.characters.begin() + record.size, record.bytes,
                 [](const line::Character &character) { return character.value; });
  record.slots = static_cast<uint8_t>(stretch.slots.size());
  readings.put(observer.telemetry().proved());
  _isRejected = line::isRejected(stretch);
  std::fill(std::begin(record.readings), std::end(record.readings), NAN);
  const uint64_t sinceUs = stretch.endUs() - std::min(stretch.endUs(), line::Readings::FreshUs);
  readings.each(sinceUs, [&record](const line::Quantity &quantity, double number) {
    record.readings[readingOf(quantity)] = number;
    record.readingCount = Record::ReadingsMax;
  });
  const std::string words = line::why(stretch);
  words.copy(record.why, sizeof record.why - 1);
  add(record);
}

}  // namespace scope

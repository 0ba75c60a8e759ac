#include "SBus2Sensor.h"

namespace {

// The time from when the timer elapses until the start bit, us: two interrupts of a Cortex-M0+ at 32 MHz (l0emu).
constexpr uint32_t TimerLead = 35;

constexpr uint16_t FrameTime = sbus::FrameSize * uint16_t{sbus::CharacterTime};  // us

}  // namespace

// The timer is stopped first: no interrupt comes while everything is cleared.
void SBus2Sensor::begin(unsigned long baud, uint32_t config) {
  stop();
  open(baud, config);
  start(baud);
}

void SBus2Sensor::listen(unsigned long baud) {
  stop();
  start(baud);
}

void SBus2Sensor::stop() {
  _port.hold();
  _isTimed = false;
  sbus::barrier();
  sbus::SlotTimer::stop(this);
}

void SBus2Sensor::start(unsigned long baud) {
  reset(baud);
  _interval.reset();
  _timedFrame = 0;
  startCallbacks(&SBus2Sensor::onReceive, this);
  _isTimed = _start(_stream, this);
}

void SBus2Sensor::end() {
  stop();
  schedule().skip();
  Decoder::end();
}

// A poll shortly before a slot waits for its start: delayMicroseconds() is exact to some us, the next poll is not.
void SBus2Sensor::parseSBusFrame() {
  constexpr int32_t WaitMax = 100;  // us
  if (_isTimed) {
    return;  // due() does all that
  }
  checkClock(_clockCheck.mayHaveStopped());
  receive(false);
  _isLate = false;
  if (!_port.tryLock()) {
    return;
  }
  answerWithin(WaitMax);
  if (_port.unlock()) {
    receive(true);
  }
}

// While interrupts are off micros() may stand still: timestamps taken before are then invalid.
void SBus2Sensor::checkClock(bool isLate) {
  if (isLate) {
    schedule().skip();
    _isLate = true;
  }
}

void SBus2Sensor::answerWithin(int32_t wait) {
  if (!schedule().isPlanned()) {
    return;
  }
  const uint32_t now = micros() + sbus::PollLead;
  const int32_t until = static_cast<int32_t>(schedule().due() - now);
  if (until > wait) {
    return;
  }
  if (until > 0) {
    sbus::SlotTimer::wait(static_cast<uint32_t>(until));
  }
  const sbus::SlotTimer::CriticalSection section;
  answer(section.start(until > 0 ? schedule().due() : now));
}

__attribute__((always_inline)) inline void SBus2Sensor::plan(bool fromCallback) {
  sbus::SlotSchedule &answers = schedule();
  const bool cameAtOnceBefore = _cameAtOnce;  // the callback before: two that are equally late would look consistent
  _cameAtOnce = fromCallback && sbus::SlotTimer::cameAtOnce();
  const uint16_t found = answers.pollFound();
  const uint32_t by = answers.pollTime();
  if (_isTimed) {
    sbus::SlotTimer::polled(found, by);
  } else if (found > 0) {
    _heardBy = by;
  }
  if (!answers.takeFrameEnd() || !_finder.isEmpty()) {
    return;
  }
  const bool isCalled = fromCallback && _isTimed;  // so no poll comes between two calls
  const bool isKnown = found > 0 && !_isLate && (cameAtOnceBefore || !isCalled);
  const sbus::ReceiveNotice notice = isKnown ? _notice : sbus::ReceiveNotice::Unknown;
  const uint32_t before = _finder.pollBefore();
  const sbus::FrameEnd end = isCalled ? sbus::frameEndOfCallback(notice, found, before, by)
                                      : sbus::SlotTimer::endOf(_isTimed, notice, found, before, by);
  const uint32_t apart = end.latest - end.earliest;
  const uint32_t frames = _finder.counters().frames;
  constexpr uint32_t SpreadMax = 1000;  // us: while no frame is expected, polls are farther apart
  if (frames != _timedFrame + 1 || apart > SpreadMax) {
    _interval.missed();
  }
  if (apart <= sbus::SlotSchedule::DeviationMax) {
    _timedFrame = frames;
    _interval.frame(end.earliest + apart / 2, answers.outcome());
  } else if (apart <= SpreadMax) {
    _interval.endedBetween(end.earliest, end.latest);
  }
  constexpr uint16_t Taken = FrameTime + sbus::SlotSchedule::DeviationMax;  // us: an interval is known to 0.1 ms
  const uint16_t interval = _interval.shortest();
  answers.plan(end.earliest, end.latest, interval > Taken ? interval - Taken : 0);
}

// If the port calls meanwhile, what it has found is planned afterwards.
void SBus2Sensor::receive(bool fromCallback) {
  while (_port.tryLock()) {
    poll(fromCallback);
    plan(fromCallback);  // inlined: on an AVR the polls must not be farther apart
    if (!_port.unlock()) {
      return;
    }
    fromCallback = true;
  }
}

// The port calls this when it has handed bytes over.
void SBus2Sensor::onReceive() {
  receive(true);
  armTimer();
}

// Runs in the timer's interrupt. If the slot is not due yet, the timer was too fast.
void SBus2Sensor::due(void *sensor) {
  SBus2Sensor &self = *static_cast<SBus2Sensor *>(sensor);
  if (!sbus::SlotTimer::HasCallback) {
    self.tick();
    return;
  }
  constexpr int32_t Close = 10;  // us
  const uint32_t start = micros() + TimerLead;
  if (static_cast<int32_t>(self.schedule().due() - start) <= Close) {
    self.answer(start);
  }
  self.armTimer();
}

// Returns how many us from now the timer must call for the next slot: a little early, as answerWithin() waits for it.
int32_t SBus2Sensor::untilDue() const {
  constexpr uint32_t Sooner = 20;
  return static_cast<int32_t>(schedule().due() - micros() - sbus::PollLead - Sooner);
}

// Sends first. Shortly before a slot it does not read the port, which may take an AVR 0.3 ms: it only counts the
// pending bytes, twice: a frame's character would come between the two looks, and both are so close to the slot that
// the slot before has ended. While a frame's end is expected it does not return to loop(): polls would be too rare.
void SBus2Sensor::tick() {
  constexpr int32_t WaitMax = 40;                       // us
  constexpr int32_t ReadingTime = 400;                  // us
  constexpr int32_t LookAhead = 180, LatestLook = 110;  // us
  sbus::SlotSchedule &answers = schedule();
  uint32_t poll = 0;
  checkClock(sbus::SlotTimer::isLate());
  answerWithin(WaitMax);
  if (!answers.isPlanned() || untilDue() > ReadingTime) {
    do {
      if (sbus::SlotTimer::isLocked()) {
        sbus::SlotTimer::callIn(0);
        return;
      }
      receive(false);
      _isLate = false;
      poll = answers.nextPoll(micros());
    } while (poll == 0);
  }
  int32_t until = answers.isPlanned() ? untilDue() : INT32_MAX;
  if (until > LookAhead) {
    _sampled = NotSampled;
    until -= LookAhead;
  } else if (_sampled == NotSampled && until > LatestLook) {
    _sampled = static_cast<int16_t>(sbus::SlotTimer::waiting(_port));
  }
  const bool isSooner = poll == 0 || until < static_cast<int32_t>(poll);
  sbus::SlotTimer::callIn(!isSooner ? poll : until > 0 ? static_cast<uint32_t>(until) : 0);
}

void SBus2Sensor::armTimer() {
  if (_isTimed && schedule().isPlanned()) {
    const int32_t until = static_cast<int32_t>(schedule().due() - micros() - TimerLead);
    sbus::SlotTimer::callIn(until > 0 ? static_cast<uint32_t>(until) : 0);
  }
}

// Returns true if nothing else sends: no frame that comes early, and no sensor in the wrong slot. Their characters
// follow each other without a gap.
bool SBus2Sensor::isLineIdle(uint32_t now) {
  constexpr uint32_t Silence = sbus::CharacterTime + 10;  // us
  return _isTimed ? sbus::SlotTimer::isLineIdle(_port, _sampled) : _port.available() <= 0 && now - _heardBy > Silence;
}

void SBus2Sensor::answer(uint32_t now) {
  uint8_t characters[sbus::SlotSize];
  const bool mayStart = !schedule().isPlanned() || isLineIdle(now);
  _sampled = NotSampled;
  if (!mayStart) {
    schedule().skip();
    return;
  }
  if (!schedule().start(now, characters)) {
    return;
  }
  const bool isSent =
      _isTimed ? sbus::SlotTimer::send(characters, sizeof characters) : _port.write(characters, sizeof characters);
  if (!isSent) {
    schedule().unsent();
  }
}

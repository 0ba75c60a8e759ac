#include "SlotSchedule.h"

#include <string.h>

#include "../sbus/Barrier.h"

namespace sbus {

namespace {

constexpr uint32_t bits(uint8_t first, uint8_t count) {
  return (count < SlotCount ? (uint32_t{1} << count) - 1 : ~uint32_t{0}) << first;
}

// Returns those slots of a group that are complete `gap` us after the frame's end even if they start as late as
// allowed.
uint8_t throughBy(uint32_t gap) {
  uint8_t slots = 0;
  uint32_t end = FirstSlotTime + SlotSchedule::DeviationMax + SlotTime;
  for (uint8_t bit = 1; bit != 0 && end < gap; bit = static_cast<uint8_t>(bit << 1)) {
    slots = static_cast<uint8_t>(slots | bit);
    end += SlotPitch;
  }
  return slots;
}

uint8_t countOf(uint8_t slots) {
  uint8_t count = 0;
  for (; slots != 0; slots = static_cast<uint8_t>(slots & (slots - 1))) {
    count++;
  }
  return count;
}

}  // namespace

void SlotSchedule::begin() {
  Telemetry::begin();
  _outcome = Outcome::None;
  _isFrameEnd = false;
  _left = 0;
  _out = 0;
  _wanted = 0;
  _hasEcho = false;
  _spread = Unsure;
  _sent = 0;
  _skipped = 0;
  _collisions = 0;
}

// plan() may interrupt this: it takes either the old data or the new.
SlotSchedule::Own &SlotSchedule::editBack() {
  Own &back = _own[_front ^ 1];
  back = _own[_front];
  return back;
}

void SlotSchedule::swap() {
  barrier();
  _front = _front ^ 1;
}

bool SlotSchedule::write(uint8_t first, uint8_t count, const SlotData *data) {
  if (first == 0 || count == 0 || first % SlotsOfGroup + count > SlotsOfGroup || first >= SlotCount) {
    return false;
  }
  Own &own = editBack();
  memcpy(own.data + first, data, count * sizeof *data);
  own.slots |= bits(first, count);
  swap();
  return true;
}

void SlotSchedule::stop(uint8_t first, uint8_t count) {
  Own &own = editBack();
  own.slots &= first < SlotCount ? ~bits(first, count) : ~uint32_t{0};
  swap();
}

// Skips what is still planned from the frame before, since it is far too late, and what was never planned.
void SlotSchedule::accepted(const uint8_t *frame) {
  skip();
  _skipped += countOf(_wanted);
  const uint32_t rejected = rejectedGroups();
  acceptWhole(frame);
  _outcome = Outcome::None;
  if (_out != 0) {
    _outcome = isEchoWrong(rejectedGroups() != rejected) ? Outcome::Collided : Outcome::Fine;
    _collisions += _outcome == Outcome::Collided;
    _out = 0;
  }
  _isFrameEnd = true;
  _endByte = frame[EndIndex];
  _group = firstSlotOf(_endByte);
  _wanted = endsVariant(_endByte, SlotsVariant) ? static_cast<uint8_t>(_own[_front].slots >> _group) : uint8_t{0};
}

// An interrupt may change the counter meanwhile, and an AVR reads byte by byte.
uint32_t SlotSchedule::steady(const uint32_t &counter) {
  uint32_t read;
  do {
    read = counter;
    barrier();
  } while (read != counter);
  return read;
}

// Once RX has heard our own echo, a missing echo means a collision.
bool SlotSchedule::isEchoWrong(bool isWrong) {
  uint8_t back = 0;
  for (uint8_t i = 0; i < SlotsOfGroup; i++) {
    SlotData data;
    const uint8_t bit = static_cast<uint8_t>(1 << i);
    if ((_out & bit) != 0 && takeEcho(static_cast<uint8_t>(_group + i), data)) {
      back = static_cast<uint8_t>(back | bit);
      isWrong = isWrong || data.data0 != _planned[i].data0 || data.data1 != _planned[i].data1;
    }
  }
  _hasEcho = _hasEcho || back != 0;
  return isWrong || (_hasEcho && back != _out);
}

void SlotSchedule::lost() {
  _isFrameEnd = false;
  Telemetry::lost();
}

void SlotSchedule::discarded(const uint8_t *bytes, int count) {
  _isFrameEnd = _isFrameEnd && count == 0;
  Telemetry::discarded(bytes, count);
}

bool SlotSchedule::takeFrameEnd() {
  const bool isEnd = _isFrameEnd;
  _isFrameEnd = false;
  return isEnd;
}

void SlotSchedule::plan(uint32_t earliest, uint32_t latest, uint32_t gap) {
  const uint8_t wanted = _wanted;
  _wanted = 0;
  const uint32_t apart = latest - earliest;
  _end = earliest + apart / 2;
  _spread = static_cast<uint16_t>(apart / 2 < Unsure ? apart / 2 : Unsure);
  const uint8_t planned = apart <= DeviationMax ? static_cast<uint8_t>(wanted & throughBy(gap)) : uint8_t{0};
  _skipped += countOf(static_cast<uint8_t>(wanted & ~planned));
  memcpy(_planned, _own[_front].data + _group, sizeof _planned);
  _slack = static_cast<uint8_t>(DeviationMax - apart / 2);
  _due = earliest + apart / 2 + FirstSlotTime;
  _at = 0;
  goTo(planned);
  barrier();
  _left = planned;  // last: now start() may come
}

// A clock without a crystal is 0.5 % off, 75 us in a period. Frames may be missing.
uint16_t SlotSchedule::nextPoll(uint32_t now) const {
  constexpr uint16_t Period = 15000;  // us, of S.BUS2
  constexpr uint16_t Margin = 150;
  constexpr uint16_t Seldom = 500;
  constexpr uint8_t MissedMax = 3;
  const uint32_t before = uint32_t{_spread} + Margin;
  uint32_t since = now - _end;
  for (uint8_t i = 0; i < MissedMax && since > Period + before; i++) {
    since -= Period;
  }
  if (before > Period / 2 || since > Period + before) {
    return Seldom;
  }
  const uint32_t from = Period - before;
  return static_cast<uint16_t>(since >= from ? 0 : from - since < Seldom ? from - since : Seldom);
}

// Moves on to the first of the slots `left` that is not before the present one.
void SlotSchedule::goTo(uint8_t left) {
  for (; left != 0 && (left >> _at & 1) == 0; _at++) {
    _due += SlotPitch;
  }
}

bool SlotSchedule::start(uint32_t now, uint8_t *characters) {
  if (_left == 0) {
    return false;
  }
  if (static_cast<int32_t>(now - _due) > _slack) {
    skip();
    return false;
  }
  const uint8_t bit = static_cast<uint8_t>(1 << _at);
  characters[0] = slotId(static_cast<uint8_t>(_group + _at));
  characters[1] = _planned[_at].data0;
  characters[2] = _planned[_at].data1;
  _out = static_cast<uint8_t>(_out | bit);
  _left = static_cast<uint8_t>(_left & ~bit);
  _sent++;
  goTo(_left);
  return true;
}

// Slots go out in rising order: the newest one is the highest bit.
void SlotSchedule::unsent() {
  uint8_t last = _out;
  while ((last & (last - 1)) != 0) {
    last = static_cast<uint8_t>(last & (last - 1));
  }
  _out = static_cast<uint8_t>(_out ^ last);
  _sent--;
  _skipped++;
}

void SlotSchedule::skip() {
  _skipped += countOf(_left);
  _left = 0;
}

}  // namespace sbus

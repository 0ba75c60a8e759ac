// What holds for whatever comes: RapidCheck's random values against the second readings of test/support. More of them,
// for the calibration, are in fuzz/Calibration.cpp.
#include <doctest/doctest.h>
#include <rapidcheck.h>

#include "support/CalibrationRules.h"
#include "support/Feed.h"
#include "support/Radio.h"
#include "support/ShowArrays.h"

namespace {

using sbus::CalibratedChannel;
using sbus::Calibration;
using sbus::Refusal;
using sbus::StoredState;

Frame anyFrame() {
  Frame frame = *rc::gen::arbitrary<Frame>();
  frame[0] = 0x0F;
  frame[23] &= 0x0F;
  frame[24] = 0x00;
  return frame;
}

// Bytes as a bad line gives them: more than half of them mean something to a receiver.
Bytes anyBytes() {
  return *rc::gen::container<Bytes>(
      rc::gen::oneOf(rc::gen::element<uint8_t>(0x0F, 0x00, 0x04, 0x08, 0x7C), rc::gen::arbitrary<uint8_t>()));
}

CalibratedChannel anyPossible() {
  const auto centre = *rc::gen::inRange<int>(1, 2047);
  auto low = *rc::gen::inRange<int>(0, centre);
  auto high = *rc::gen::inRange<int>(centre + 1, 2048);
  const auto deadZone = *rc::gen::inRange<int>(0, std::min(centre - low, high - centre));
  if (*rc::gen::arbitrary<bool>()) {
    std::swap(low, high);
  }
  return {{static_cast<uint16_t>(low), static_cast<uint16_t>(centre), static_cast<uint16_t>(high)},
          static_cast<uint16_t>(deadZone)};
}

}  // namespace

TEST_CASE("frames survive unpacking and packing") {
  CHECK(rc::check("pack(unpack(frame)) == frame", [] {
    const Frame frame = anyFrame();
    Channels channels;
    sbus::unpack(frame.data(), channels.data());
    RC_ASSERT(channels == readBitByBit(frame));
    Frame again;
    sbus::pack(again.data(), channels.data(), sbus::failsafe(frame.data()), sbus::lostFrame(frame.data()));
    RC_ASSERT(again == frame);
  }));
}

TEST_CASE("whatever comes, only pieces of it that are frames are delivered, in order and without overlap") {
  CHECK(rc::check("delivered frames stand in the stream", [] {
    const Bytes bytes = anyBytes() + bytesOf(PaperLow.bytes) + anyBytes() + bytesOf(PaperHigh.bytes) + anyBytes();
    const auto burst = *rc::gen::inRange<size_t>(1, 70);
    auto from = bytes.begin();
    for (const Frame &frame : feedNew(bytes, burst)) {
      RC_ASSERT(sbus::isFrame(frame.data()));
      const auto found = std::search(from, bytes.end(), frame.begin(), frame.end());
      RC_ASSERT(found != bytes.end());
      from = found + 25;
    }
  }));
}

TEST_CASE("any frames that one receiver sends without damage are delivered, all and in order, at once") {
  CHECK(rc::check("clean stream in == frames out", [] {
    const auto kind = *rc::gen::element<uint8_t>(0x00, 0x04, 0x08);
    Frames frames(*rc::gen::inRange<size_t>(0, 50));
    Bytes bytes;
    for (Frame &frame : frames) {
      frame = anyFrame();
      frame[24] = static_cast<uint8_t>(kind == 0x04 ? kind | (*rc::gen::arbitrary<uint8_t>() & 0x30) : kind);
      bytes = bytes + bytesOf(frame) + tailOf(kind);
    }
    Feeder line;
    RC_ASSERT(line.lock(kind).feed(bytes, *rc::gen::inRange<size_t>(1, 70)) == frames);
  }));
}

TEST_CASE("what can be is good, exact at the three points, and without a dead zone scaled as its range is") {
  CHECK(rc::check("any possible channel", [] {
    Calibration calibration;
    for (CalibratedChannel &channel : calibration.channels) {
      channel = anyPossible();
    }
    seal(calibration);
    RC_ASSERT(sbus::stateOf(calibration) == StoredState::Good);
    for (CalibratedChannel &channel : calibration.channels) {
      RC_ASSERT(isExact(channel));
      channel.deadZone = 0;
      for (uint16_t raw = 0; raw < 2048; raw = static_cast<uint16_t>(raw + 13)) {
        RC_ASSERT(channel.toNormalised(raw) == sbus::toNormalised(raw, channel.range));
        RC_ASSERT(channel.toMicroseconds(raw) == sbus::toMicroseconds(raw, channel.range));
      }
    }
  }));
}

TEST_CASE("whatever sticks a radio has, they are found: exact at their three points, centred within their jitter") {
  CHECK(rc::check("calibrated == what the sticks are", [] {
    struct Stick {
      int low, rest, high, jitter;
      bool atEnd, backwards;
    };
    std::array<Stick, 16> sticks;
    for (Stick &stick : sticks) {
      const auto length = *rc::gen::inRange<int>(400, 2048);
      stick.low = *rc::gen::inRange<int>(0, 2048 - length);
      stick.high = stick.low + length;
      stick.atEnd = *rc::gen::inRange<int>(0, 4) == 0;
      stick.backwards = *rc::gen::arbitrary<bool>();
      stick.jitter = stick.atEnd ? 0 : *rc::gen::inRange<int>(0, 17);
      const int quarter = (length + 3) / 4;
      stick.rest = stick.low + (!stick.atEnd      ? *rc::gen::inRange<int>(quarter + 1, length - quarter)
                                : stick.backwards ? length
                                                  : 0);
    }
    Radio radio;
    const auto feed = [&](auto value) {
      for (size_t i = 0; i < sticks.size(); i++) {
        radio.channels[i] = static_cast<uint16_t>(value(sticks[i]));
      }
      radio.feed();
    };
    feed([](const Stick &stick) { return *rc::gen::inRange<int>(stick.low, stick.high + 1); });
    feed([](const Stick &stick) { return stick.high; });
    feed([](const Stick &stick) { return stick.low; });
    radio.calibrator.centre();
    feed([](const Stick &stick) { return stick.rest + stick.jitter; });
    feed([](const Stick &stick) { return stick.rest - stick.jitter; });
    radio.calibrator.high();
    feed([](const Stick &stick) { return stick.backwards ? stick.low : stick.high; });

    const Finished finished(radio.calibrator, 0xFFFF);
    RC_ASSERT(finished.refusal == Refusal::None);
    RC_ASSERT(finished.isGood());
    for (size_t i = 0; i < sticks.size(); i++) {
      const Stick &stick = sticks[i];
      const CalibratedChannel &found = finished.calibration.channels[i];
      RC_ASSERT(isExact(found));
      RC_ASSERT(found.range.low == (stick.backwards ? stick.high : stick.low));
      RC_ASSERT(found.range.high == (stick.backwards ? stick.low : stick.high));
      RC_ASSERT(found.range.centre == (stick.atEnd ? (stick.low + stick.high + 1) / 2 : stick.rest));
      for (int raw = stick.rest - stick.jitter; !stick.atEnd && raw <= stick.rest + stick.jitter; raw++) {
        RC_ASSERT(found.toNormalised(static_cast<uint16_t>(raw)) == 0);
      }
    }
  }));
}

// Properties of all input: RapidCheck's random values, compared with the plain implementations of test/support. Those
// of any bytes are in fuzz/FrameFinderFuzz.cpp.
#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <utility>

#include "support/CalibrationRules.h"
#include "support/Feed.h"
#include "support/Radio.h"
#include "support/ShowArrays.h"

namespace {

using sbus::CalibratedChannel;
using sbus::Calibration;
using sbus::StoredState;

Frame anyFrame() {
  Frame frame = *rc::gen::arbitrary<Frame>();
  frame[0] = 0x0F;
  frame[23] &= 0x0F;
  frame[24] = 0x00;
  return frame;
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

TEST_CASE("all frames of a receiver are delivered, each by the poll that finds its last byte") {
  CHECK(rc::check("clean stream in == frames out", [] {
    const auto kind = *rc::gen::element<uint8_t>(0x00, 0x04, 0x08);
    const bool gaps = *rc::gen::arbitrary<bool>();
    const auto burst = *rc::gen::inRange<size_t>(1, 26);
    Feeder line;
    line.lock(kind);
    for (Frame frame : *rc::gen::container<Frames>(rc::gen::exec(anyFrame))) {
      frame[24] = static_cast<uint8_t>(kind == 0x04 ? kind | (*rc::gen::arbitrary<uint8_t>() & 0x30) : kind);
      RC_ASSERT(line.feed(part(frame, 0, 25 - burst), burst).empty());
      RC_ASSERT(line.feed(part(frame, 25 - burst), burst) == Frames{frame});
      line.feed(tailOf(kind), burst);
      line.wait(gaps ? Feeder::GapUs : 0);
    }
  }));
}

TEST_CASE("every possible calibration is good, exact at the three points, and on the lines between them") {
  CHECK(rc::check("any possible channel", [] {
    Calibration calibration;
    for (CalibratedChannel &channel : calibration.channels) {
      channel = anyPossible();
      RC_ASSERT(isExact(channel));
      const auto raw = *rc::gen::inRange<uint16_t>(0, 2048);
      RC_ASSERT(std::abs(channel.toNormalized(raw) - onTheLines(raw, channel, 0, 1000)) <= 0.5);
      RC_ASSERT(std::abs(channel.toMicroseconds(raw) - onTheLines(raw, channel, 1500, 512)) <= 0.5);
    }
    seal(calibration);
    RC_ASSERT(sbus::stateOf(calibration) == StoredState::Good);
  }));
}

TEST_CASE("every stick that a radio may have is measured: exact at its three points, centred within its jitter") {
  CHECK(rc::check("calibrated == what the stick is", [] {
    const auto low = *rc::gen::inRange<int>(0, 1648);
    const auto high = *rc::gen::inRange<int>(low + 400, 2048);
    const int quarter = (high - low + 3) / 4;
    const auto rest = *rc::gen::inRange<int>(low + quarter + 1, high - quarter);
    const auto jitter = *rc::gen::inRange<int>(0, 17);
    const auto backwards = *rc::gen::arbitrary<bool>();
    Radio radio({low, high}, {rest + jitter, rest - jitter});
    radio.calibrator.high();
    radio.hold(backwards ? low : high);
    const Finished finished(radio.calibrator, 0x0001);
    RC_ASSERT(finished.isGood());
    const CalibratedChannel &found = finished.calibration.channels[0];
    RC_ASSERT(isExact(found));
    RC_ASSERT(found.range.low == (backwards ? high : low));
    RC_ASSERT(found.range.centre == rest);
    RC_ASSERT(found.range.high == (backwards ? low : high));
    for (int raw = rest - jitter; raw <= rest + jitter; raw++) {
      RC_ASSERT(found.toNormalized(static_cast<uint16_t>(raw)) == 0);
    }
  }));
}

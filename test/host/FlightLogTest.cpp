// A flight in bounded memory, and the dates of recordings.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>
#include <set>
#include <string>

#include "line/recording/Recording.h"
#include "line/recording/RecordingWriter.h"
#include "line/recording/WallTime.h"
#include "line/report/Curves.h"
#include "line/report/ObservedFlight.h"
#include "line/report/SvgPlot.h"
#include "line/simulation/SimulatedReceiver.h"
#include "sbus/Frame.h"

namespace {

// Takes a frame that ends at `us`.
void fly(line::ObservedFlight &flight, uint64_t us, bool failsafe, bool lostFrame, uint16_t first = 992) {
  uint16_t channels[sbus::ChannelCount] = {first, 992, 172, 992};
  uint8_t frame[sbus::FrameSize];
  sbus::pack(frame, channels, failsafe, lostFrame);
  for (size_t i = 0; i < sbus::FrameSize; i++) {
    flight.put({us - (sbus::FrameSize - 1 - i) * line::CharacterUs, frame[i]});
  }
  flight.idleUntil(us);
}

}  // namespace

TEST_CASE("ten hours of curves need 2048 stretches of time, and keep the ends of the sticks") {
  line::Curves curves;
  constexpr uint64_t Frames = 4000000;
  for (uint64_t i = 0; i < Frames; i++) {
    const auto value = static_cast<uint16_t>(i == Frames / 2 ? 1811 : 992);
    const uint16_t channels[line::Curves::Channels] = {value, 172, 992, static_cast<uint16_t>(i % 2000)};
    curves.put(i * 9000, channels, i != Frames / 4);
  }
  CHECK(curves.buckets().size() <= 2048);
  CHECK(curves.buckets().size() > 1024);
  size_t peaks = 0, parts = 0;
  for (const line::Curves::Bucket &bucket : curves.buckets()) {
    peaks += bucket.most[0] == 1811;
    parts += !bucket.joined;
  }
  CHECK(peaks == 1);
  CHECK(parts == 2);
}

TEST_CASE("a line with more silences than room has curves all the same") {
  line::Curves curves;
  for (uint64_t i = 0; i < 100000; i++) {
    const uint16_t channels[line::Curves::Channels] = {992, 992, 172, 992};
    curves.put(i * 200000, channels, false);
  }
  CHECK(curves.buckets().size() <= 2048);
}

TEST_CASE("the report draws a flight's curve as the area between its ends in each pixel, a silence divides it") {
  line::ObservedFlight flight(line::CharacterUs);
  for (unsigned i = 0; i < 20000; i++) {
    if (i < 9000 || i > 9100) {
      fly(flight, 5000 + uint64_t{i} * 9000, false, false, i % 2 == 0 ? 172 : 1811);
    }
  }
  flight.finish();
  const std::string svg = line::curvesOf(flight.log());
  const size_t from = svg.find(" d=\"", svg.find("curve c0")) + 4;
  const std::string path = svg.substr(from, svg.find('"', from) - from);
  std::set<double> heights;
  unsigned points = 0, areas = 0;
  for (size_t at = 0; at < path.size(); at++) {
    double x = 0, y = 0;
    if (std::sscanf(path.c_str() + at, "%*1[ML]%lf %lf", &x, &y) == 2) {
      heights.insert(y);
      points++;
    }
    areas += path[at] == 'Z';
  }
  CHECK(heights.size() == 2);  // 172 and 1811
  CHECK(areas == 2);
  CHECK(points <= 2 * 792);  // the plot's pixels
  CHECK(points > 1000);
}

TEST_CASE("a flight's worst seconds, its strip and its verdict are by what was lost") {
  // 10 s at 9 ms. In second 3 every second frame is lost, in second 6 every third one does not come; from 8.0 s
  // failsafe.
  line::ObservedFlight flight(line::CharacterUs);
  for (unsigned i = 0; i < 1111; i++) {
    const uint64_t us = 5000 + uint64_t{i} * 9000;
    const uint64_t second = us / 1000000;
    if (second != 6 || i % 3 != 0) {
      fly(flight, us, second >= 8, second >= 8 || (second == 3 && i % 2 == 0));
    }
  }
  flight.finish();
  CHECK(flight.log().rate().perSecond() == doctest::Approx(111.1).epsilon(0.02));
  CHECK(flight.log().rate().missing() == 37);
  const std::vector<line::FlightRating> worst = line::worstSeconds(flight.log(), 3);
  REQUIRE(worst.size() == 2);  // the span of failsafe is listed elsewhere
  CHECK(worst[0].fromUs == 3000000);
  CHECK(worst[0].lost == doctest::Approx(0.5).epsilon(0.03));
  CHECK(worst[1].fromUs == 6000000);
  const std::vector<line::FlightRating> strip = line::stripOf(flight.log(), 480);
  REQUIRE(strip.size() == 10);
  CHECK(strip[1].lost == 0);
  CHECK(strip[6].lost == doctest::Approx(0.33).epsilon(0.05));
  CHECK(strip[9].failsafe);
  CHECK(line::stripOf(flight.log(), 2).size() == 2);
  CHECK(line::verdictOf(flight.log()).text.substr(0, 30) == "Failsafe 1 time, longest 2.0 s");
}

TEST_CASE("a date is written and read to the microsecond") {
  struct {
    int64_t us;
    const char *text;
  } const table[] = {{0, "1970-01-01T00:00:00.000000Z"},
                     {1795619778123456, "2026-11-25T15:16:18.123456Z"},
                     {951782399999999, "2000-02-28T23:59:59.999999Z"},
                     {951868800000000, "2000-03-01T00:00:00.000000Z"},
                     {951782400000000, "2000-02-29T00:00:00.000000Z"},
                     {4107542399000000, "2100-02-28T23:59:59.000000Z"},
                     {4107542400000000, "2100-03-01T00:00:00.000000Z"},
                     {-1, "1969-12-31T23:59:59.999999Z"}};
  for (const auto &each : table) {
    CAPTURE(each.text);
    CHECK(line::wallTime(each.us) == each.text);
    int64_t us = 0;
    CHECK(line::parseWallTime(each.text, us));
    CHECK(us == each.us);
  }
  int64_t us = 0;
  for (const char *wrong : {"", "1970-01-01T00:00:01Z", "1970-13-01T00:00:01.000000Z", "1970-1-01T00:00:01.000000Z",
                            "1970-01-01T00:00:01.5Z", "1970-01-01T00:00:01.000000", "1970-01-01T00:00:01.000000Zx"}) {
    CAPTURE(wrong);
    CHECK_FALSE(line::parseWallTime(wrong, us));
  }
}

TEST_CASE("a recording says when it began, and an older one does not") {
  line::RecordingWriter writer;
  writer.comment("sbus record sim");
  writer.began(951782399999999);
  writer.opened(line::LineSettings());
  const std::string text = writer.take();
  CHECK(text == "# sbus record sim\n# format 1, began 2000-02-28T23:59:59.999999Z\n# 100000 baud, 8E2, inverted\n");
  CHECK(line::startIn(text) == 951782399999999);
  CHECK(line::settingsIn(text) == line::LineSettings());
  CHECK_FALSE(line::startIn("# 100000 baud, 8E2, inverted\n120 0F\n"));
  CHECK_FALSE(line::startIn("120 0F\n# format 1, began 2000-02-28T23:59:59.999999Z\n"));
}

TEST_CASE("a line counts from its first byte or a capture's beginning to its last, with frames or without") {
  struct {
    uint64_t beginUs;       // of the capture; 0: it is none
    uint64_t byteUs[2];     // of bytes that are no frame: one before the frames; every 5 ms after them, up to this time
    uint64_t silentToUs;    // known at the end
    uint64_t fromUs, toUs;  // of the flight
    size_t spans;
    const char *end;
    uint64_t againUs = 2950000;  // the first of the bytes after the frames
  } const table[] = {
      {0, {0, 0}, 0, 2000000, 2900000, 0, ""},
      {1950000, {0, 0}, 2990000, 2000000, 2900000, 0, ""},
      {0, {1000120, 0}, 0, 1000000, 2900000, 1, ""},
      {500000, {0, 0}, 0, 500000, 2900000, 1, ""},
      {500000, {1000120, 0}, 0, 500000, 2900000, 1, ""},
      {0, {0, 3500000}, 0, 2000000, 3500000, 1, "No frames at the end: for the last 0.600 s bytes come, but no frame."},
      {0, {0, 2950000}, 4000000, 2000000, 4000000, 1, "No frames at the end: for the last 1.100 s the line is silent."},
      {0,
       {1000120, 3500000},
       4000000,
       1000000,
       4000000,
       2,
       "No frames at the end: for the last 1.100 s bytes come, but no frame."},
      {0,
       {0, 3500000},
       0,
       2000000,
       3500000,
       1,
       "No frames at the end: for the last 0.600 s the line is silent.",
       3500000},
  };
  for (const auto &row : table) {
    CAPTURE(&row - table);
    line::ObservedFlight flight(line::CharacterUs);
    if (row.beginUs > 0) {
      flight.begin(row.beginUs);
    }
    if (row.byteUs[0] > 0) {
      flight.put({row.byteUs[0], 0x55});
    }
    for (uint64_t us = 2000000; us <= 2900000; us += 9000) {
      fly(flight, us, false, false);
    }
    for (uint64_t us = row.againUs; us <= row.byteUs[1]; us += 5000) {
      flight.put({us, 0x55});
    }
    for (uint64_t us = std::max<uint64_t>(2950000, row.byteUs[1]); us < row.silentToUs; us += 50000) {
      flight.idleUntil(std::min(us + 50000, row.silentToUs));
    }
    flight.idleUntil(9000000, true);
    flight.finish();
    CHECK(flight.log().fromUs() == row.fromUs);
    CHECK(flight.log().toUs() == row.toUs);
    CHECK(flight.log().spans(line::FlagSpan::Kind::NoFrames).size() == row.spans);
    CHECK(flight.log().endText() == row.end);
    CHECK((line::verdictOf(flight.log()).severity == line::FlightVerdict::Severity::Good) == (row.spans == 0));
  }
}

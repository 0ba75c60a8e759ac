// The PPM signal of the example PpmOut: what is in each frame, and where it begins and ends.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "../../examples/PpmOut/Ppm.h"

namespace {

struct Sent {
  std::vector<int> channels;  // us
  int period;                 // us, to the next frame
  int sync;                   // us
};

void write(Ppm &ppm, const std::vector<int> &us) {
  int16_t channels[Ppm::Channels];
  std::copy(us.begin(), us.end(), channels);
  ppm.write(channels);
}

// Takes a frame, from its first pulse on.
Sent sentBy(Ppm &ppm) {
  Sent sent = {{}, 0, 0};
  for (unsigned part = 0; part < 2 * Ppm::Channels; part += 2) {
    const Ppm::Part pulse = ppm.next(), space = ppm.next();
    CHECK((pulse.isPulse && !space.isPulse));
    CHECK(pulse.us == 300);
    sent.channels.push_back(pulse.us + space.us);
    sent.period += sent.channels.back();
  }
  const Ppm::Part last = ppm.next(), rest = ppm.next(), end = ppm.next();
  CHECK((last.isPulse && !rest.isPulse && !end.isPulse));
  CHECK(last.us == 300);
  sent.sync = last.us + rest.us + end.us;
  sent.period += sent.sync;
  return sent;
}

bool isSilent(Ppm &ppm) {
  const Ppm::Part part = ppm.next();
  return !part.isPulse && part.us == 1000;
}

const std::vector<int> Centred(8, 1500);

}  // namespace

TEST_CASE(
    "a frame has eight channels between nine pulses of 300 us, 22500 us in all; values out of range are clamped") {
  const struct {
    std::vector<int> us, sent;
    int sync;
  } rows[] = {
      {Centred, Centred, 10500},
      {{988, 2012, 1500, 1501, 1499, 1000, 2000, 1234}, {988, 2012, 1500, 1501, 1499, 1000, 2000, 1234}, 10766},
      {std::vector<int>(8, 2012), std::vector<int>(8, 2012), 6404},
      {std::vector<int>(8, 988), std::vector<int>(8, 988), 14596},
      {std::vector<int>(8, 2201), std::vector<int>(8, 2200), 4900},
      {std::vector<int>(8, 32767), std::vector<int>(8, 2200), 4900},
      {std::vector<int>(8, 799), std::vector<int>(8, 800), 16100},
      {std::vector<int>(8, -32768), std::vector<int>(8, 800), 16100},
  };
  Ppm ppm;
  for (const auto &row : rows) {
    write(ppm, row.us);
    for (unsigned repeated = 0; repeated < 3; repeated++) {
      const Sent sent = sentBy(ppm);
      CHECK(sent.channels == row.sent);
      CHECK(sent.sync == row.sync);
      CHECK(sent.period == 22500);
    }
  }
}

TEST_CASE("before the first channels there are no pulses; stop() lets a frame end, and then there are none") {
  Ppm ppm;
  CHECK(isSilent(ppm));
  ppm.stop();
  CHECK(isSilent(ppm));
  write(ppm, Centred);
  CHECK(sentBy(ppm).channels == Centred);
  for (unsigned parts = 1; parts < 19; parts++) {
    CAPTURE(parts);
    for (unsigned part = 0; part < parts; part++) {
      CHECK(ppm.next().isPulse == (part % 2 == 0 && part < 18));
    }
    ppm.stop();
    for (unsigned part = parts; part < 19; part++) {
      CHECK(ppm.next().isPulse == (part % 2 == 0 && part < 18));
    }
    CHECK(isSilent(ppm));
    CHECK(isSilent(ppm));
    write(ppm, Centred);
  }
}

TEST_CASE("channels that are set within a frame wait for the next frame: no frame mixes old and new channels") {
  const std::vector<int> other(8, 1100);
  for (unsigned parts = 1; parts < 19; parts++) {
    CAPTURE(parts);
    Ppm ppm;
    write(ppm, Centred);
    int us = 0;
    for (unsigned part = 0; part < 19; part++) {
      if (part == parts) {
        write(ppm, other);
      }
      us += ppm.next().us;
    }
    CHECK(us == 22500);
    CHECK(sentBy(ppm).channels == other);
  }
}

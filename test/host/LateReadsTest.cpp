// A stall between line and program: bytes that were late are no silence, bytes that are missing are one.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "impairment/ImpairedLine.h"
#include "impairment/Settings.h"
#include "line/ports/PortReads.h"
#include "line/recording/RecordingReader.h"
#include "line/recording/RecordingWriter.h"
#include "line/recording/Words.h"
#include "line/report/ObservedFlight.h"
#include "support/Adapter.h"

namespace {

using SpanKind = line::FlagSpan::Kind;

struct Stall {
  uint32_t periodUs;
  uint32_t latencyUs;
  uint32_t lookUs;  // from one look at the port to the next
  uint64_t us;      // nothing comes for this long
};

constexpr uint64_t FromUs = 2000000, EndUs = 8000000;

// Returns a recording of a steady line at an adapter, from 2 s on of one at which nothing comes; then what was sent
// meanwhile, or, if it `isCut`, only what is sent from then on. The program finds the port empty at each look.
std::string recorded(const Stall &stall, bool isCut, line::Random &random) {
  line::PortReads reads(line::CharacterUs, stall.latencyUs);
  line::RecordingWriter writer;
  Adapter adapter(stall.latencyUs, random);
  const auto take = [&](const Read &read) {
    reads.empty(read.us / stall.lookUs * stall.lookUs - stall.lookUs);
    reads.begin(read.characters.size(), read.us, line::PortReads::UsualLatencyUs);
    for (const line::Character &sent : read.characters) {
      writer.put(reads.next(sent.value));
    }
  };
  PayloadFrames sticks(Payload::Smooth, random);
  const uint64_t fromUs = FromUs + random.below(stall.periodUs), toUs = fromUs + stall.us;
  uint64_t lastUs = 0;
  for (uint64_t us = 20000; us < EndUs; us += stall.periodUs) {
    Frame frame = sticks.next();
    frame[sbus::FrameSize - 2] = 0;
    for (size_t i = 0; i < frame.size(); i++) {
      const uint64_t sentUs = us + i * line::CharacterUs;
      const bool isHeld = sentUs >= fromUs && sentUs < toUs;
      if (!isHeld || !isCut) {
        lastUs = std::max(isHeld ? toUs : sentUs, lastUs + 1);
        adapter.put({lastUs, frame[i]}, take);
      }
    }
  }
  adapter.runTo(EndUs + 100000, take);
  writer.finish();
  return writer.take();
}

// Reads it as a page and the command do. Returns how many reads were late.
unsigned read(line::ObservedFlight &flight, const std::string &text) {
  line::RecordingReader reader(line::CharacterUs, true);
  std::deque<line::Character> characters;
  std::string wrong;
  for (std::string_view rest = text; !rest.empty() && wrong.empty();) {
    wrong = reader.line(line::takeLine(rest), characters);
  }
  CHECK(wrong + reader.finish(characters) == "");
  unsigned reads = 0;
  uint32_t lateUs = 0;
  for (const line::Character &character : characters) {
    reads += character.lateUs >= 100000 && character.lateUs != lateUs;
    lateUs = character.lateUs;
    flight.put(character);
  }
  flight.finish();
  return reads;
}

}  // namespace

TEST_CASE("bytes that a stalled adapter delivers late are the PC's fault, bytes that it does not deliver a silence") {
  const uint64_t seed = seedOfDay();
  CAPTURE(seed);
  const Stall table[] = {
      {9000, 16000, 1000, 130000},   {22000, 16000, 1000, 180000},  {14000, 16000, 1000, 140000},
      {9000, 1000, 1000, 287000},    {9000, 16000, 1000, 287000},   {9000, 16000, 10000, 287000},
      {9000, 16000, 1000, 180000},   {9000, 16000, 1000, 1000000},  {9000, 16000, 10000, 2500000},
      {7000, 16000, 10000, 300000},  {14000, 16000, 10000, 300000}, {14000, 1000, 10000, 300000},
      {14000, 16000, 1000, 1500000}, {14000, 16000, 40000, 400000}, {22000, 16000, 1000, 400000},
  };
  for (const Stall &stall : table) {
    CAPTURE(stall.periodUs);
    CAPTURE(stall.latencyUs);
    CAPTURE(stall.us);
    for (uint64_t run = 0; run < 20; run++) {
      line::Random held(seed + run), cut(seed + run);
      line::ObservedFlight late(line::CharacterUs), silent(line::CharacterUs);
      CHECK(read(late, recorded(stall, false, held)) == 1);
      CHECK(late.log().spans(SpanKind::NoFrames).empty());
      CHECK(late.log().spans(SpanKind::Late).size() == 1);
      CHECK(late.observer().counters().frames >= (EndUs - 20000) / stall.periodUs - 1);
      CHECK(read(silent, recorded(stall, true, cut)) == 0);
      CHECK(silent.log().spans(SpanKind::Late).empty());
      REQUIRE(silent.log().spans(SpanKind::NoFrames).size() == 1);
      CHECK(silent.log().spans(SpanKind::NoFrames)[0].us() + 60000 > stall.us);
    }
  }
}

TEST_CASE("a recording from an adapter has the frames a second of its line, and none of them is missing") {
  const uint64_t seed = seedOfDay();
  CAPTURE(seed);
  for (const uint32_t periodUs : {6300u, 7000u, 9000u, 11000u, 14000u, 15000u, 22000u}) {
    for (const uint32_t latencyUs : {1000u, 4000u, 16000u}) {
      for (const uint32_t lookUs : {1000u, 10000u, 30000u}) {
        CAPTURE(periodUs);
        CAPTURE(latencyUs);
        CAPTURE(lookUs);
        line::Random random(seed);
        line::ObservedFlight flight(line::CharacterUs);
        read(flight, recorded({periodUs, latencyUs, lookUs, 0}, false, random));
        CHECK(flight.log().rate().perSecond() == doctest::Approx(1e6 / periodUs).epsilon(0.01));
        CHECK(flight.log().rate().missing() == 0);
        CHECK(worstSeconds(flight.log(), 10).empty());
        CHECK(line::verdictOf(flight.log()).text == "All well: no failsafe, no silence, 0.00 % of the frames lost.");
      }
    }
  }
}

// The receiver on a clean line: every frame, in order, however the bytes are cut; and the buffers that it swaps.
#include "sbus/Receiver.h"

#include <doctest/doctest.h>

#include <type_traits>

#include "Feed.h"
#include "KnownFrames.h"
#include "ShowArrays.h"

static_assert(!std::is_copy_constructible<sbus::Receiver>::value, "a copy's pointers would lead into the original");
static_assert(!std::is_copy_assignable<sbus::Receiver>::value, "a copy's pointers would lead into the original");

namespace {

const Bytes Low(PaperLow.bytes.begin(), PaperLow.bytes.end());
const Frames Clean = {PaperLow.bytes, PaperHigh.bytes, Neutral.bytes, Sbus2.bytes, PaperLow.bytes};

}  // namespace

TEST_CASE("before the first frame there is none") {
  Feeder feeder;
  CHECK(feeder.receiver.frame() == nullptr);
  feeder.feed(Bytes(Low.begin(), Low.end() - 1));
  CHECK(feeder.receiver.frame() == nullptr);
}

TEST_CASE("a clean stream gives exactly its frames, in order, in lumps of any size") {
  for (size_t lump = 1; lump <= 130; lump++) {
    CAPTURE(lump);
    CHECK(feedNew(join(Clean), lump) == Clean);
  }
}

TEST_CASE("two frames are found wherever their bytes are cut in two lumps") {
  const Frames frames = {Neutral.bytes, PaperHigh.bytes};
  const Bytes bytes = join(frames);
  for (auto cut = bytes.begin(); cut <= bytes.end(); ++cut) {
    CAPTURE(cut - bytes.begin());
    Feeder feeder;
    Frames found = feeder.feed(Bytes(bytes.begin(), cut), 64);
    for (const Frame &frame : feeder.feed(Bytes(cut, bytes.end()), 64)) {
      found.push_back(frame);
    }
    CHECK(found == frames);
  }
}

TEST_CASE("a frame is complete with its 25th byte, not before and not later") {
  Feeder feeder;
  for (unsigned round = 0; round < 3; round++) {
    for (unsigned index = 0; index < 25; index++) {
      CAPTURE(index);
      CHECK(feeder.feed({Low[index]}).size() == (index == 24 ? 1 : 0));
    }
  }
}

TEST_CASE("receiving nothing changes nothing") {
  Feeder feeder;
  for (unsigned round = 0; round < 3; round++) {
    CHECK(feeder.look({}).empty());
    CHECK(feeder.idle().empty());
    CHECK(feeder.feed(Low).size() == 1);
    CHECK(feeder.look({}).empty());
    CHECK(feeder.idle().empty());
  }
  CHECK(lastFrame(feeder.receiver) == PaperLow.bytes);
}

TEST_CASE("the last complete frame stays untouched while the next comes in") {
  Feeder feeder;
  feeder.feed(join({PaperLow.bytes}));
  const uint8_t *const address = feeder.receiver.frame();
  for (unsigned index = 0; index < 24; index++) {
    CAPTURE(index);
    CHECK(feeder.feed({PaperHigh.bytes[index]}).empty());
    CHECK(feeder.receiver.frame() == address);
    CHECK(lastFrame(feeder.receiver) == PaperLow.bytes);
  }
}

TEST_CASE("the two buffers take turns, and a frame is handed out where it came in") {
  Feeder feeder;
  const uint8_t *addresses[4];
  for (const uint8_t *&address : addresses) {
    const uint8_t *const cameIn = feeder.receiver.space();
    feeder.feed(Low, 25);
    address = feeder.receiver.frame();
    CHECK(address == cameIn);
  }
  CHECK(addresses[0] != addresses[1]);
  CHECK(addresses[2] == addresses[0]);
  CHECK(addresses[3] == addresses[1]);
}

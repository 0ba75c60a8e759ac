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
  sbus::Receiver receiver;
  CHECK(receiver.frame() == nullptr);
  feed(receiver, Bytes(Low.begin(), Low.end() - 1));
  CHECK(receiver.frame() == nullptr);
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
    sbus::Receiver receiver;
    Frames found = feed(receiver, Bytes(bytes.begin(), cut), 64);
    for (const Frame &frame : feed(receiver, Bytes(cut, bytes.end()), 64)) {
      found.push_back(frame);
    }
    CHECK(found == frames);
  }
}

TEST_CASE("a frame is complete with its 25th byte, not before and not later") {
  sbus::Receiver receiver;
  for (unsigned round = 0; round < 3; round++) {
    for (unsigned index = 0; index < 25; index++) {
      CAPTURE(index);
      CHECK(feed(receiver, {Low[index]}).size() == (index == 24 ? 1 : 0));
    }
  }
}

TEST_CASE("receiving nothing changes nothing") {
  sbus::Receiver receiver;
  CHECK_FALSE(receiver.received(0));
  CHECK(feed(receiver, Low).size() == 1);
  CHECK_FALSE(receiver.received(0));
  CHECK(lastFrame(receiver) == PaperLow.bytes);
}

TEST_CASE("the last complete frame stays untouched while the next comes in") {
  sbus::Receiver receiver;
  feed(receiver, join({PaperLow.bytes}));
  const uint8_t *const address = receiver.frame();
  for (unsigned index = 0; index < 24; index++) {
    CAPTURE(index);
    CHECK(feed(receiver, {PaperHigh.bytes[index]}).empty());
    CHECK(receiver.frame() == address);
    CHECK(lastFrame(receiver) == PaperLow.bytes);
  }
}

TEST_CASE("the two buffers take turns, and a frame is handed out where it came in") {
  sbus::Receiver receiver;
  const uint8_t *addresses[4];
  for (const uint8_t *&address : addresses) {
    const uint8_t *const cameIn = receiver.space();
    feed(receiver, Low, 25);
    address = receiver.frame();
    CHECK(address == cameIn);
  }
  CHECK(addresses[0] != addresses[1]);
  CHECK(addresses[2] == addresses[0]);
  CHECK(addresses[3] == addresses[1]);
}

TEST_CASE("reset forgets the complete frame and the beginning of the next") {
  sbus::Receiver receiver;
  feed(receiver, Low + Bytes(Low.begin(), Low.begin() + 12));
  receiver.reset();
  CHECK(receiver.frame() == nullptr);
  CHECK(feed(receiver, Bytes(Low.begin() + 12, Low.end())).empty());
  CHECK(receiver.frame() == nullptr);
  CHECK(feed(receiver, Low) == Frames{PaperLow.bytes});
}

TEST_CASE("behind a break the torn frame is not completed, and the last complete one is kept") {
  for (unsigned torn = 0; torn < 25; torn++) {
    CAPTURE(torn);
    sbus::Receiver receiver;
    feed(receiver, join({PaperHigh.bytes}) + Bytes(Low.begin(), Low.begin() + torn));
    receiver.broken();
    CHECK(lastFrame(receiver) == PaperHigh.bytes);
    CHECK(feed(receiver, Bytes(Low.begin() + torn, Low.end())).size() == (torn == 0 ? 1 : 0));
    CHECK(feed(receiver, join({Neutral.bytes})) == Frames{Neutral.bytes});
  }
}

// A port that calls back, as the Grasshopper's: no method of DecodeSBus has to be called in time. Each frame is handed
// over when it ends, the first once the next begins, and what loop() does meanwhile changes nothing.
#include <doctest/doctest.h>

#include <algorithm>
#include <climits>
#include <vector>

#include "line/simulation/Random.h"
#include "support/Bytes.h"
#include "support/KnownFrames.h"
#include "support/ShowArrays.h"

#include "support/FakeSerial.h"
#include "support/ListeningBoard.h"

namespace {

constexpr uint64_t Ms = 1000;  // us

// An open board that notes each frame, as it is handed over.
struct Listening : ListeningBoard {
  std::vector<Channels> frames;

  Listening() {
    sbus.setTimeout(0);
    sbus.begin();
    called = [this] { take(); };
    pass(20 * Ms);
  }

  void take() {
    if (sbus.newFrame()) {
      Channels channels{};
      bool failsafe, lostFrame;
      sbus.decodeSBusFrame(channels.data(), failsafe, lostFrame);
      frames.push_back(channels);
    }
  }

  // Returns how many of the frames are not `right`.
  long wrong(const Channels &right) const {
    return std::count_if(frames.begin(), frames.end(), [&](const Channels &each) { return each != right; });
  }
};

}  // namespace

TEST_CASE(
    "the first frame waits for the next one's first bytes, or for a call that finds the line silent; the second is "
    "there "
    "once the line is idle after it") {
  for (size_t noise = 0; noise < 32; noise++) {
    for (const bool isPolled : {false, true}) {
      INFO("noise ", noise, ", isPolled ", isPolled);
      Listening board;
      board.send(Bytes(noise, 0x55));
      board.pass(10 * Ms);
      board.send(bytesOf(PaperLow.bytes));
      board.pass(6 * Ms + 120);
      CHECK(board.sbus.counters().frames == 0);
      if (isPolled) {
        board.sbus.parseSBusFrame();
      }
      CHECK(board.sbus.counters().frames == isPolled);
      board.send(bytesOf(PaperHigh.bytes));
      CHECK(board.sbus.counters().frames >= 1);
      board.pass(120);
      CHECK(board.sbus.counters().frames == 2);
      REQUIRE(!board.frames.empty());
      CHECK(board.frames.front() == PaperLow.channels);
      CHECK(board.frames.back() == PaperHigh.channels);
    }
  }
}

TEST_CASE(
    "the silence after 36 characters that one call found is seen: what came before it is no part of the next frame") {
  for (unsigned ring = 0; ring < 16; ring++) {
    CAPTURE(ring);
    Listening board;
    board.send(Bytes(ring, 0x55));
    board.pass(60 * Ms);
    for (unsigned number = 0; number < 4; number++) {
      board.frame(bytesOf(plainFrame(number)), 9 * Ms);
    }
    // 22 characters of one receiver, and 14 of another, which begins at once: the first 25 look like a frame. With the
    // last 11 of them 14 of the next frame would look like a frame, too.
    Frame parts{}, rest{}, next = Neutral.bytes;
    parts[0] = rest[0] = 0x0F;
    next[12] = next[13] = 0;
    board.send(bytesOf(parts) + Bytes(rest.begin(), rest.begin() + 11));
    board.pass(6 * Ms);
    board.frames.clear();
    board.frame(bytesOf(next), 9 * Ms);
    board.frame(bytesOf(next), 9 * Ms);
    CHECK(board.wrong(readBitByBit(next)) == 0);
    CHECK(board.frames.size() == 2);
  }
}

TEST_CASE("a byte 0F of noise, 2 ms or more before a stretched frame, begins no frame") {
  for (const uint64_t earlyUs : {2000u, 3000u, 5000u}) {
    for (const bool isSpread : {true, false}) {
      INFO("earlyUs ", earlyUs, ", isSpread ", isSpread);
      ListeningBoard board;
      board.sbus.begin();
      unsigned wrong = 0, right = 0;
      for (unsigned number = 0; number < 40; number++) {
        const Frame frame = withByte(withByte(plainFrame(number), 22, 0), 21, 0x1F);  // CH16 is 0
        const bool isNoisy = number == 10 || number == 31;  // 252 and 777 characters: not at a half of the ring
        const uint64_t beganUs = fakeMicros;
        board.pass(7000 - (isNoisy ? earlyUs + 120 : 0));
        if (isNoisy) {
          board.send({0x0F});
          board.pass(earlyUs);
        }
        for (size_t i = 0; i < frame.size(); i++) {
          board.send(part(frame, i, i + 1));
          board.pass(isSpread ? 120 : i == 3 || i == 23 ? 300 : 0);
        }
        board.pass(14000 - (fakeMicros - beganUs));
        SBusFrame received;
        if (board.sbus.read(received)) {
          (std::equal(received.channels, received.channels + 18, readBitByBit(frame).begin()) ? right : wrong)++;
        }
      }
      CHECK(wrong == 0);
      CHECK(right >= 32);
    }
  }
}

TEST_CASE("a character 00 after each frame costs no frame for long, wherever the frames stand in the ring") {
  ListeningBoard board;
  board.sbus.begin();
  for (unsigned number = 0; number < 200; number++) {
    board.frame(bytesOf(plainFrame(number)) + Bytes{0}, 9 * Ms);
  }
  CHECK(board.sbus.counters().frames >= 180);
}

TEST_CASE(
    "frames of 24 channels are never taken for 16, though the port hands over at a damaged character: 25 characters "
    "may "
    "stand before it") {
  for (const uint16_t channel17 : {uint16_t{0}, uint16_t{1024}}) {
    for (unsigned every = 1; every <= 10; every++) {
      INFO("channel17 ", channel17, ", every ", every);
      ListeningBoard board;
      board.sbus.begin();
      board.pass(20 * Ms);
      for (unsigned number = 0; number < 400; number++) {
        LongChannels channels;
        channels.fill(1024);
        channels[0] = static_cast<uint16_t>(1000 + number);
        channels[16] = channel17;
        channels[17] = 0;
        board.send(bytesOf(writeBitByBit(channels)), number % every == 0 ? 25 : SIZE_MAX);
        board.pass(9 * Ms - 36 * 120);
      }
      CHECK(board.sbus.counters().frames == 0);
    }
  }
}

// Adafruit_NeoPixel masks interrupts for 30 us a LED, a DHT22's driver for 5 ms, SoftwareSerial for 1 ms a character.
TEST_CASE("interrupts masked for some hundred us of each ms, which delay what the port hands over, cost no frame") {
  for (const uint64_t maskedUs : {100u, 130u, 150u, 200u, 400u, 700u}) {
    for (const uint64_t periodUs : {7000u, 9000u, 9370u, 14000u}) {
      INFO("maskedUs ", maskedUs, ", periodUs ", periodUs);
      Listening board;
      board.maskedUs = maskedUs;
      for (unsigned number = 0; number < 200; number++) {
        board.frame(bytesOf(plainFrame(number)), periodUs);
      }
      board.sbus.parseSBusFrame();
      CHECK(board.sbus.counters().frames >= 199);
      CHECK(board.sbus.counters().discardedBytes <= 25);
    }
  }
}

TEST_CASE(
    "an object that was never begun, was ended or has died takes no bytes from the port's owner, and is not called") {
  enum Before { Never, Ended, Died };
  for (const Before before : {Never, Ended, Died}) {
    CAPTURE(static_cast<int>(before));
    ListeningBoard board;
    DecodeSBus other(board.port);
    {
      DecodeSBus dying(board.port);
      if (before == Died) {
        dying.begin();
        board.frame(bytesOf(plainFrame(0)), 9 * Ms);
      }
    }
    board.frame(bytesOf(plainFrame(0)), 9 * Ms);
    if (before == Ended) {
      other.begin();
      board.frame(bytesOf(plainFrame(0)), 9 * Ms);
      other.end();
    }
    board.sbus.begin();
    board.pass(20 * Ms);
    const uint32_t seen = other.counters().frames;
    for (unsigned number = 0; number < 300; number++) {
      board.send(part(plainFrame(number), 0, 20));
      SBusFrame frame;
      other.linkState();
      other.parseSBusFrame();
      other.read(frame);
      CHECK(frame.failsafe);
      board.send(part(plainFrame(number), 20));
      board.pass(9 * Ms - 25 * 120);
    }
    CHECK(board.sbus.counters().frames == 300);
    CHECK(other.counters().frames == seen);
  }
}

TEST_CASE("if the port's event is lost, a method that finds the newest frame old reads what waits, and all goes on") {
  Listening board;
  for (unsigned number = 0; number < 3; number++) {
    board.frame(bytesOf(plainFrame(number)), 9 * Ms);
  }
  board.losesEvents = true;
  board.frame(bytesOf(plainFrame(3)), 9 * Ms);
  board.losesEvents = false;
  board.frame(bytesOf(plainFrame(4)), 9 * Ms);
  CHECK(board.sbus.counters().frames == 3);  // no event comes before bytes are read
  CHECK_FALSE(board.sbus.newFrame());
  board.pass(100 * Ms);
  CHECK(board.sbus.counters().frames == 3);
  board.sbus.newFrame();
  const uint32_t found = board.sbus.counters().frames;
  for (unsigned number = 5; number < 10; number++) {
    board.frame(bytesOf(plainFrame(number)), 9 * Ms);
  }
  CHECK(board.sbus.counters().frames >= found + 4);
}

TEST_CASE("a sketch's own onReceive() replaces the library's, and frames come by its calls of parseSBusFrame()") {
  static Listening *self;
  Listening board;
  self = &board;
  board.port.onReceive(Callback([] { self->sbus.parseSBusFrame(); }));
  for (unsigned number = 0; number < 20; number++) {
    board.frame(bytesOf(plainFrame(number)), 9 * Ms);
  }
  CHECK(board.sbus.counters().frames == 20);
  board.port.onReceive(Callback([] {}));
  board.frame(bytesOf(plainFrame(20)), 9 * Ms);
  CHECK(board.sbus.counters().frames == 20);
  board.sbus.parseSBusFrame();
  CHECK(board.sbus.counters().frames == 21);
}

TEST_CASE("listen() takes what waits, so that the port calls; end() stops the calls; begin() starts them again") {
  ListeningBoard board;
  board.port.begin(100000, SERIAL_SBUS);
  board.frame(bytesOf(PaperLow.bytes), 9 * Ms);  // the event finds no callback
  board.sbus.listen();
  for (unsigned number = 0; number < 5; number++) {
    board.frame(bytesOf(plainFrame(number)), 9 * Ms);
  }
  CHECK(board.sbus.counters().frames >= 5);
  board.sbus.end();
  board.port.begin(100000, SERIAL_SBUS);
  const uint32_t before = board.sbus.counters().frames;
  board.frame(bytesOf(PaperLow.bytes), 9 * Ms);
  CHECK(board.sbus.counters().frames == before);
  CHECK(board.port.available() == 25);
  board.sbus.begin();
  for (unsigned number = 0; number < 5; number++) {
    board.frame(bytesOf(plainFrame(number)), 9 * Ms);
  }
  CHECK(board.sbus.counters().frames == 5);
}

TEST_CASE(
    "a port that calls back without a buffer of its own, as USB does, is polled: its bytes come in packets, late") {
  struct Usb : FakeSerial {
    unsigned callbacks = 0;
    using FakeSerial::onReceive;
    void onReceive(Callback) { callbacks++; }
  } usb;
  DecodeSBus sbus(usb);
  sbus.begin();
  CHECK(usb.callbacks == 0);
}

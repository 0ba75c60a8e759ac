// The interrupt that polls comes while loop() is within a method of DecodeSBusBackground: each is interrupted after
// each of its instructions (support/SingleStep.h), and no frame is lost, none is wrong, and counters() are of one
// moment.
#include <DecodeSBus32.h>
#include <DecodeSBusBackground.h>
#include <doctest/doctest.h>

#include <cstring>
#include <utility>

#include "Cores.h"
#include "support/Bytes.h"
#include "support/KnownFrames.h"
#include "support/SingleStep.h"

decltype(Serial1) Serial1, Serial2;

#if defined(SINGLE_STEP)

namespace {

using cores::world;

constexpr uint64_t Ms = 1000;  // us

using Background = DecodeSBusBackgroundOf<DecodeSBus32>;  // has all methods

// A port whose methods nothing interrupts: what would come meanwhile comes at their end.
class Port : public HardwareSerial {
 public:
  void begin(unsigned long, uint16_t) override { _first = _count = 0; }
  void end() override {}
  int available() override { return static_cast<int>(_count); }
  int peek() override { return -1; }
  int read() override {
    _isWorking = true;
    const int value = _count == 0 ? -1 : _buffer[_first % sizeof _buffer];
    _first += _count != 0;
    _count = _count - (_count != 0);
    _isWorking = false;
    if (_isDue) {
      _isDue = false;
      interrupt();
    }
    return value;
  }
  size_t write(uint8_t) override { return 1; }
  int availableForWrite() override { return 1; }
  operator bool() override { return true; }

  // Returns true if it works: then interrupt() is called later.
  bool isWorking() {
    _isDue = _isWorking;
    return _isWorking;
  }
  void arrive(const uint8_t *bytes, size_t size) {
    for (size_t i = 0; i < size; i++) {
      _buffer[(_first + _count) % sizeof _buffer] = bytes[i];
      _count = _count + 1;
    }
  }

 private:
  uint8_t _buffer[64] = {};
  size_t _first = 0;
  volatile size_t _count = 0;
  volatile bool _isWorking = false, _isDue = false;
};

// In sync with a line of frames, 9 ms apart, polled each millisecond.
struct Scene {
  Port port;
  Background sbus{port};
  unsigned next = 0;
  Frame frame{};  // the one that comes

  Scene() {
    sim::startTicks();
    sbus.begin();
    silence(20);
    for (int i = 0; i < 3; i++) {
      first();
      last();
      silence(6 + i);
    }
  }
  ~Scene() { sbus.end(); }
  void silence(unsigned ms) {
    for (unsigned i = 0; i < ms; i++) {
      world.nowUs += 1 * Ms;
      sbus::PolledByTimer::pollDecoders();
    }
  }
  // `waits`: no poll takes the second half of these.
  void first(bool waits = false) {
    frame = withByte(plainFrame(next), 23, next % 2 == 0 ? 0x00 : 0x04);
    next++;
    world.nowUs += 8 * 120;
    port.arrive(frame.data(), 8);
    sbus::PolledByTimer::pollDecoders();
    world.nowUs += 8 * 120;
    port.arrive(frame.data() + 8, 8);
    if (!waits) {
      sbus::PolledByTimer::pollDecoders();
    }
  }
  void last() {
    world.nowUs += 9 * 120;
    port.arrive(frame.data() + 16, 9);
    sbus::PolledByTimer::pollDecoders();
  }
  // Requires that all frames so far have come, and that the newest is right.
  void check() {
    REQUIRE(sbus.counters().frames == next);
    REQUIRE(sbus.counters().discardedBytes == 0);
    Channels channels{};
    bool failsafe, lostFrame;
    sbus.decodeSBusFrame(channels.data(), failsafe, lostFrame);
    REQUIRE(channels == readBitByBit(frame));
    REQUIRE(lostFrame == (next % 2 == 0));
  }
};

Scene *scene;

// Interrupts `work(scene)`, in the middle of a frame, by its end; then calls `after(scene)`.
template <typename Work, typename After>
void everyInstruction(const Work &work, const After &after, bool waits = false) {
  interrupt = [] {
    if (!scene->port.isWorking()) {
      scene->last();
    }
  };
  forEveryInstruction([&](unsigned long instruction) {
    world.nowUs = 1000000 + instruction * 131;
    Scene now;
    scene = &now;
    now.first(waits);
    const bool happened = interrupted(instruction, [&] { work(now); });
    if (!happened) {
      CHECK(instruction > 3);
      now.last();
    }
    after(now);
    return happened;
  });
}

void goesOn(Scene &now) {
  now.check();
  now.silence(6);
  now.first();
  now.last();
  now.check();
}

}  // namespace

TEST_CASE("while the interrupt brings the end of a frame, each method works, and all frames come") {
  using Method = void (*)(Background &);
  static Channels channels;
  everyInstruction([](Scene &now) { now.sbus.parseSBusFrame(); }, goesOn, true);
  const Method methods[] = {
      [](Background &sbus) { sbus.SBusFrameOk(); },
      [](Background &sbus) { sbus.newFrame(); },
      [](Background &sbus) {
        static SBusFrame frame;
        sbus.read(frame);
      },
      [](Background &sbus) { sbus.linkState(); },
      [](Background &sbus) { sbus.setTimeout(100); },
      [](Background &sbus) { sbus.setLossLimit(100); },
      [](Background &sbus) { sbus.decodeExtraChannels(channels.data()); },
  };
  for (const Method &method : methods) {
    everyInstruction([&](Scene &now) { method(now.sbus); }, goesOn);
  }
}

TEST_CASE("decodeSBusFrame() and frameAge() are those of the frame before or of the one that comes") {
  static Channels channels;
  static bool failsafe, lostFrame;
  everyInstruction([](Scene &now) { now.sbus.decodeSBusFrame(channels.data(), failsafe, lostFrame); },
                   [](Scene &now) {
                     const bool isNew = channels == readBitByBit(now.frame);
                     REQUIRE((isNew || channels == readBitByBit(plainFrame(now.next - 2))));
                     REQUIRE(lostFrame == ((now.next - isNew) % 2 != 0));
                     goesOn(now);
                   });
  static unsigned long age;
  everyInstruction([](Scene &now) { age = now.sbus.frameAge(); },
                   [](Scene &now) {
                     REQUIRE(age <= 15);
                     goesOn(now);
                   });
}

TEST_CASE("counters() are those before the interrupt or those after it") {
  static sbus::Counters counters;
  everyInstruction([](Scene &now) { counters = now.sbus.counters(); },
                   [](Scene &now) {
                     const sbus::Counters after = now.sbus.counters();
                     sbus::Counters before = after;
                     if (counters.frames != after.frames) {
                       before.frames--;
                       before.lostFrames -= now.next % 2 == 0;
                       before.period = counters.period;
                       REQUIRE(counters.period != after.period);
                     }
                     REQUIRE(std::memcmp(&counters, &before, sizeof before) == 0);
                     goesOn(now);
                   });
}

TEST_CASE("a sketch that waits for newFrame(), and calls nothing else, sees the frame that comes") {
  everyInstruction(
      [](Scene &now) {
        Channels channels{};
        bool failsafe, lostFrame;
        now.sbus.decodeSBusFrame(channels.data(), failsafe, lostFrame);
        for (int i = 0; i < 3 && !now.sbus.newFrame(); i++) {
        }
      },
      [](Scene &now) { goesOn(now); });
}

TEST_CASE("begin(), listen() and end() while the interrupt comes: afterwards frames come, or none") {
  for (const bool isOpened : {false, true}) {
    everyInstruction([=](Scene &now) { isOpened ? now.sbus.begin() : now.sbus.listen(); },
                     [](Scene &now) {
                       REQUIRE(now.sbus.counters().frames <= 1);
                       now.silence(20);
                       for (int i = 0; i < 4; i++) {
                         now.first();
                         now.last();
                         now.silence(6);
                       }
                       REQUIRE(now.sbus.counters().frames >= 4);
                       Channels channels{};
                       bool failsafe, lostFrame;
                       now.sbus.decodeSBusFrame(channels.data(), failsafe, lostFrame);
                       REQUIRE(channels == readBitByBit(now.frame));
                     });
  }
  everyInstruction([](Scene &now) { now.sbus.end(); },
                   [](Scene &now) {
                     const uint32_t frames = now.sbus.counters().frames;
                     now.silence(6);
                     now.first();
                     now.last();
                     REQUIRE(now.sbus.counters().frames == frames);
                   });
}

#endif

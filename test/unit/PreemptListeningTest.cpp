// A port that calls back while loop() is within a method of DecodeSBus: each is interrupted after each of its
// instructions (support/SingleStep.h), and no frame is lost, none is wrong, and counters() are of one moment.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <functional>

#include "support/Bytes.h"
#include "support/KnownFrames.h"
#include "support/SingleStep.h"

#include "support/CleanArduino.h"
#include "support/FakeClock.h"

#include <DecodeSBusTelemetry.h>

#if defined(SINGLE_STEP)

namespace {

constexpr uint64_t Ms = 1000;  // us

// Calls back as the board's port does. What comes while one of its own methods runs comes at its end: there the driver
// masks interrupts, or an interrupt changes nothing that the method has read.
class Port : public HardwareSerial {
 public:
  void begin(unsigned long) override {}
  void begin(unsigned long, uint32_t) override {
    const Work work(*this);
    _first = 0;
    _state.rx_count = 0;
    _state.rx_event = true;
  }
  void begin(unsigned long baud, uint32_t config, uint8_t *, size_t) { begin(baud, config); }
  void end() override {
    const Work work(*this);
    _state.rx_count = 0;
  }
  void onReceive(Callback callback) {
    const Work work(*this);
    _callback = callback;
  }
  int available() override { return static_cast<int>(_state.rx_count); }
  int peek() override { return -1; }
  int read() override {
    uint8_t value;
    return read(&value, 1) == 1 ? value : -1;
  }
  int read(uint8_t *buffer, size_t size) override {
    const Work work(*this);
    _state.rx_event = true;
    size_t count = 0;
    for (; count < size && _state.rx_count > 0; count++) {
      _state.rx_count = _state.rx_count - 1;
      buffer[count] = _buffer[_first++ % sizeof _buffer];
    }
    return static_cast<int>(count);
  }
  void flush() override {}
  size_t write(uint8_t) override { return 1; }
  operator bool() override { return true; }

  // Hands bytes over, and calls back. `isLost`: PendSV's queue is full.
  void arrive(const uint8_t *bytes, size_t size, bool isLost = false) {
    if (_isWorking) {
      _late = bytes;
      _lateSize = size;
      return;
    }
    // The first half of a frame fills a half of the port's ring, the other part ends at an idle line.
    _state.rx_index = static_cast<uint16_t>(size);
    for (size_t i = 0; i < size; i++) {
      _buffer[(_first + _state.rx_count) % sizeof _buffer] = bytes[i];
      _state.rx_count = _state.rx_count + 1;
    }
    if (_state.rx_event) {
      _state.rx_event = false;
      _isDue = !isLost;
      callBack();
    }
  }

  // Makes the call that is due. PendSV does not interrupt itself (armv6m_pendsv.c:133).
  void callBack() {
    while (_isDue && !_isCalling && !isMasked) {
      _isDue = false;
      _isCalling = true;
      _callback.call();
      _isCalling = false;
    }
  }
  bool isMasked = false;  // PendSV does not run

  stm32l0_uart_t &state() { return _state; }

 private:
  struct Work {
    explicit Work(Port &port) : _port(port) {
      port._isWorking = true;
      sbus::barrier();
    }
    ~Work() {
      sbus::barrier();
      _port._isWorking = false;
      if (_port._lateSize != 0) {
        const size_t size = _port._lateSize;
        _port._lateSize = 0;
        _port.arrive(_port._late, size);
      }
    }
    Port &_port;
  };

  uint8_t _buffer[64] = {};
  size_t _first = 0;
  stm32l0_uart_t _state{};
  volatile bool _isWorking = false;
  volatile bool _isDue = false;
  volatile bool _isCalling = false;
  const uint8_t *_late = nullptr;
  volatile size_t _lateSize = 0;
  Callback _callback;
};

// By this the library knows the core's state of the port.
stm32l0_uart_t *uartOf(Port &port) { return &port.state(); }

// In sync with a line of frames, 9 ms apart.
struct Scene {
  Port port;
  DecodeSBus sbus{port};
  unsigned next = 0;
  Frame frame{};  // the one that comes

  Scene() {
    sbus.begin();
    fakeMicros += 20 * Ms;
    for (int i = 0; i < 3; i++) {
      whole();
    }
  }
  void first() {
    fakeMicros += 6 * Ms;
    frame = withByte(plainFrame(next), 23, next % 2 == 0 ? 0x00 : 0x04);
    next++;
    fakeMicros += 16 * 120;
    port.arrive(frame.data(), 16);
  }
  void last() {
    fakeMicros += 10 * 120;
    port.arrive(frame.data() + 16, 9);
  }
  void whole() {
    first();
    last();
  }
  // Requires that all frames so far have come, and that the newest is right.
  void check() {
    REQUIRE(sbus.counters().frames == next);
    REQUIRE(sbus.counters().discardedBytes == 0);
    Channels channels{};
    bool failsafe, lostFrame;
    sbus.decodeSBusFrame(channels.data(), failsafe, lostFrame);
    REQUIRE(channels == readBitByBit(frame));
  }
};

Scene *scene;

// Interrupts `work(scene)`, which begins after `before(scene)`, by `during`; then calls `after(scene, happened)`.
template <typename Before, typename Work, typename After>
void everyInstruction(const Before &before, const Work &work, void (*during)(), const After &after) {
  interrupt = during;
  forEveryInstruction([&](unsigned long instruction) {
    fakeMicros = 1000000 + instruction * 131;
    Scene now;
    scene = &now;
    before(now);
    const bool happened = interrupted(instruction, [&] { work(now); });
    if (!happened) {
      CHECK(instruction > 3);
      during();
    }
    after(now, happened);
    return happened;
  });
}

const auto nothing = [](Scene &) {};

}  // namespace

TEST_CASE("parseSBusFrame() in loop() while the port calls back: the frame is there, and those after it") {
  everyInstruction([](Scene &now) { now.first(); }, [](Scene &now) { now.sbus.parseSBusFrame(); },
                   [] { scene->last(); },
                   [](Scene &now, bool) {
                     now.check();
                     now.whole();
                     now.check();
                   });
}

TEST_CASE("... also if an event was lost, and loop() finds the bytes") {
  everyInstruction(
      [](Scene &now) {
        fakeMicros += 6 * Ms + 16 * 120;
        now.frame = plainFrame(now.next++);
        now.port.arrive(now.frame.data(), 16, true);
      },
      [](Scene &now) { now.sbus.parseSBusFrame(); }, [] { scene->last(); },
      [](Scene &now, bool) {
        now.sbus.parseSBusFrame();
        now.check();
        now.whole();
        now.check();
      });
}

TEST_CASE("the end of a frame that comes while the port calls for its first half is not left in the port") {
  everyInstruction(
      [](Scene &now) {
        SBusFrame before;
        now.sbus.read(before);
        now.port.isMasked = true;
        now.first();
        now.port.isMasked = false;
      },
      [](Scene &now) { now.port.callBack(); }, [] { scene->last(); },
      [](Scene &now, bool) { REQUIRE(now.sbus.newFrame()); });
}

TEST_CASE("counters() while the port calls back are those before it or those after it") {
  static sbus::Counters counters, before;
  everyInstruction([](Scene &now) { before = now.sbus.counters(); }, [](Scene &now) { counters = now.sbus.counters(); },
                   [] { scene->whole(); },
                   [](Scene &now, bool) {
                     const sbus::Counters after = now.sbus.counters();
                     REQUIRE(after.frames == before.frames + 1);
                     REQUIRE((std::memcmp(&counters, &before, sizeof before) == 0 ||
                              std::memcmp(&counters, &after, sizeof after) == 0));
                   });
}

TEST_CASE("a sketch that waits for newFrame() sees the frame that the port brings") {
  everyInstruction(
      [](Scene &now) {
        Channels channels{};
        bool failsafe, lostFrame;
        now.sbus.decodeSBusFrame(channels.data(), failsafe, lostFrame);
      },
      [](Scene &now) {
        for (int i = 0; i < 20 && !now.sbus.newFrame(); i++) {
        }
      },
      [] { scene->whole(); }, [](Scene &now, bool) { REQUIRE(now.sbus.newFrame()); });
}

TEST_CASE("frameAge() while a frame comes is that of the frame before it or its own") {
  static unsigned long age;
  everyInstruction([](Scene &) { fakeMicros += 7 * Ms; }, [](Scene &now) { age = now.sbus.frameAge(); },
                   [] {
                     scene->whole();
                     fakeMicros += 5 * Ms;
                   },
                   [](Scene &, bool) { REQUIRE(age >= 5); });
}

TEST_CASE("read() while a frame comes gives one whole frame, no younger than it is, and says whether it is new") {
  static SBusFrame value;
  static bool isNew;
  everyInstruction(
      [](Scene &now) {
        now.sbus.read(value);
        fakeMicros += 7 * Ms;
      },
      [](Scene &now) { isNew = now.sbus.read(value); }, [] { scene->whole(); },
      [](Scene &now, bool) {
        const Channels newest = readBitByBit(now.frame), before = readBitByBit(plainFrame(now.next - 2));
        const bool isNewest = std::equal(newest.begin(), newest.end(), value.channels);
        REQUIRE((isNewest || std::equal(before.begin(), before.end(), value.channels)));
        REQUIRE(isNew == isNewest);
        REQUIRE(now.sbus.newFrame() == !isNewest);
        REQUIRE(value.lostFrame == ((now.next - isNewest) % 2 != 0));
        REQUIRE_FALSE(value.failsafe);
        REQUIRE((isNewest || value.age >= 7));
      });
}

TEST_CASE("a sensor's age while a frame comes is that of its value, never less") {
  struct Line {
    Port port;
    DecodeSBusTelemetry sbus{port};
    unsigned next = 0;
    Line() {
      sbus.begin();
      fakeMicros += 20 * Ms;
    }
    void frame() {
      const Frame frame = plainFrame(next, static_cast<uint8_t>(next % 4 << 4 | 4));
      next++;
      fakeMicros += 12 * Ms + 16 * 120;
      port.arrive(frame.data(), 16);
      fakeMicros += 9 * 120;
      port.arrive(frame.data() + 16, 9);
    }
    void slot() {
      constexpr uint8_t Slot[] = {0x03, 0xC0, 0x2E};
      port.arrive(Slot, sizeof Slot);
    }
  };
  static Line *line;
  interrupt = [] { line->frame(); };
  forEveryInstruction([&](unsigned long instruction) {
    fakeMicros = 1000000 + instruction * 131;
    Line now;
    line = &now;
    uint64_t came = 0;
    for (int i = 0; i < 6; i++) {
      now.frame();
      if (now.next == 5) {
        came = fakeMicros;
        now.slot();
      }
    }
    fakeMicros += 7 * Ms;
    const uint64_t least = (fakeMicros - came) / Ms;
    sbus::ReceiverVoltage voltage;
    sbus::Trust trust;
    const bool happened = interrupted(instruction, [&] { REQUIRE(now.sbus.readSensor(0, voltage, trust)); });
    REQUIRE(voltage.decivolts == 46);
    REQUIRE(trust.age >= least);
    REQUIRE(trust.age <= least + 30);
    return happened;
  });
}

TEST_CASE("begin(), listen() and end() while the port calls back: afterwards frames come, or none") {
  for (const bool isOpened : {false, true}) {
    everyInstruction(
        nothing, [=](Scene &now) { isOpened ? now.sbus.begin() : now.sbus.listen(); }, [] { scene->whole(); },
        [](Scene &now, bool) {
          const uint32_t frames = now.sbus.counters().frames;
          REQUIRE(frames <= 1);
          fakeMicros += 9 * Ms;
          now.sbus.parseSBusFrame();
          for (int i = 0; i < 4; i++) {
            now.whole();
          }
          REQUIRE(now.sbus.counters().frames >= 4);
          Channels channels{};
          bool failsafe, lostFrame;
          now.sbus.decodeSBusFrame(channels.data(), failsafe, lostFrame);
          REQUIRE(channels == readBitByBit(now.frame));
        });
  }
  everyInstruction(
      nothing, [](Scene &now) { now.sbus.end(); }, [] { scene->whole(); },
      [](Scene &now, bool) {
        const uint32_t frames = now.sbus.counters().frames;
        now.whole();
        REQUIRE(now.sbus.counters().frames == frames);
      });
}

#endif

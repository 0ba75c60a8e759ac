/// @file
/// Answers as a sensor on an S.BUS2 line, and decodes the line.
#pragma once

#include "DecodeSBusTelemetry.h"
#include "port/timer/SlotTimer.h"
#include "sbus2/FrameInterval.h"
#include "sbus2/SlotSchedule.h"

#if defined(SBUS_BACKGROUND)
#error "DecodeSBusBackground would delay the answers of an SBus2Sensor: extras/docs/interrupts.md"
#endif
#define SBUS_SENSOR

namespace sbus {

/// Chooses SBus2Sensor's constructor for a single wire.
enum SingleWireTag : uint8_t {
  SingleWire  ///< TX is the line.
};

/// @cond  Not for sketches.

// The slot timer polls, or the sketch.
struct PolledBySlotTimer : PolledByLoop {
  struct Lock : SlotTimer::Lock {
    explicit Lock(const PolledBySlotTimer &) {}
  };
};

/// @endcond

}  // namespace sbus

/// Decodes an S.BUS2 line like DecodeSBusTelemetry, and answers as a sensor on the same port:
///
///     SBus2Sensor dSBus(Serial1);
///     void setup() { dSBus.begin(); }
///     void loop() {
///       dSBus.parseSBusFrame();
///       sbus::VoltageSbs01V voltage = {56, 125};  // 5.6 V and 12.5 V
///       dSBus.writeSensor(6, voltage);
///     }
///
/// TX goes to the line through a diode, anode at TX; on a Teensy 4 TX may be the line itself
/// (extras/docs/answering.md). An answer follows only an accepted frame that announces its group, and is never in slot
/// 0. It starts within 100 us of its time, and ends before the next frame could begin; otherwise it is skipped. After
/// begin() the sensor first listens for 17 frames. Nothing else may write to the port.
///
/// On a port that does not show when a frame ended, the sensor never answers, and skippedSlots() grows: any Stream
/// other than a hardware serial port, and the ports of some cores (extras/docs/answering.md).
///
/// Where an interrupt or a task reads the port, the methods of DecodeSBusTelemetry block it. On an
/// ESP32 they wait for that task, for up to 1.5 ms. Do not call them from an interrupt. A function that takes a
/// DecodeSBusTelemetry does not take an SBus2Sensor: make it a template (see DecodeSBusBackgroundOf).
class SBus2Sensor : protected DecodeSBusTelemetryOf<sbus::SlotSchedule, sbus::PolledBySlotTimer> {
  using Decoder = DecodeSBusTelemetryOf<sbus::SlotSchedule, sbus::PolledBySlotTimer>;

 public:
  using Decoder::ChannelArray;     ///< see DecodeSBusOf
  using Decoder::counters;         ///< see DecodeSBusOf
  using Decoder::decodeSBusFrame;  ///< see DecodeSBusOf
  using Decoder::Frame;            ///< see DecodeSBusOf
  using Decoder::frameAge;         ///< see DecodeSBusOf
  using Decoder::linkState;        ///< see DecodeSBusOf
  using Decoder::newFrame;         ///< see DecodeSBusOf
  using Decoder::readSensor;       ///< see DecodeSBusTelemetryOf
  using Decoder::rejectedGroups;   ///< see DecodeSBusTelemetryOf
  using Decoder::SBusFrameOk;      ///< see DecodeSBusOf
  using Decoder::setLossLimit;     ///< see DecodeSBusOf
  using Decoder::setTimeout;       ///< see DecodeSBusOf

  /// See DecodeSBusOf().
  template <typename Port>
  explicit SBus2Sensor(Port &port)
      : Decoder(port), _stream(port), _start(start<Port>), _notice(sbus::KindOf<Port>::Notice) {
    static_assert(sbus::KindOf<Port>::Sends, "An SBusPin only receives: extras/docs/sbuspin.md");
  }

  /// See DecodeSBusOf(), with pins.
  template <typename Port>
  SBus2Sensor(Port &port, int8_t rx, int8_t tx)
      : Decoder(port, rx, tx), _stream(port), _start(start<Port>), _notice(sbus::KindOf<Port>::Notice) {}

  /// Remembers `port`, and uses its TX as the line itself, without a diode; RX stays free:
  /// `SBus2Sensor dSBus(Serial1, sbus::SingleWire)`. The board drives TX only while it answers. Only a Teensy 4 can do
  /// this (Teensyduino 1.59 and later); for other ports this constructor does not compile. It was tried only on a
  /// stand-in.
  ///
  /// begin() then always opens the port inverted, whatever its `config`. Nothing else may open the port: it would hold
  /// the line. Do not turn interrupts off for more than 100 us: an interrupt releases the line.
  template <typename Port>
  SBus2Sensor(Port &port, sbus::SingleWireTag) : SBus2Sensor(port) {
    _port.onSingleWire(port);
  }

  /// Opens the port, like DecodeSBusOf::begin().
  void begin(unsigned long baud = sbus::Baud, uint32_t config = sbus::Inverted);

  /// Starts on a port that the sketch has opened, like DecodeSBusOf::listen().
  void listen(unsigned long baud = sbus::Baud);

  /// Stops answering, and closes the port, like DecodeSBusOf::end().
  void end();

  /// Reads the pending bytes, like DecodeSBusOf::parseSBusFrame(), and sends the answer that is due.
  ///
  /// On a Grasshopper, a Pico and an AVR with a timer 2, interrupts do all this; on an ESP32 a task does. There this
  /// method does nothing, and the sketch need not call it. On all other boards call it at least every 75 us: a later
  /// poll cannot know when the frame ended, and skips its answers. If a slot begins within 100 us, the method waits for
  /// it. On these boards do not disable interrupts for longer than 0.1 ms; a Teensy 4 notices this, and skips answers.
  /// Do not call it from an interrupt.
  void parseSBusFrame();

  /// See DecodeSBusOf.
  bool read(Frame &frame) {
    parseSBusFrame();
    const Lock lock(*this);
    return writeTo(frame);
  }

  // ---- Answering

  /// Answers with `sensor`, a type of sbus2/Sensors.h, from slot `slot` on, 1..31, until the next call or stopSensor().
  /// An answer never mixes the values of two calls. Returns false if a value is out of range, and answers with the
  /// nearest value in range. Returns false, and changes nothing, for slot 0, and if the sensor's slots do not lie
  /// within one group of eight. Call it at any rate.
  template <typename Sensor>
  bool writeSensor(uint8_t slot, const Sensor &sensor) {
    sbus::SlotData data[Sensor::Slots];
    const bool fits = sensor.encode(data);
    const sbus::SlotTimer::OtherCoreLock lock;
    return schedule().write(slot, Sensor::Slots, data) && fits;
  }

  /// Stops answering in `count` slots from slot `slot` on. The radio then shows that the sensor is gone.
  void stopSensor(uint8_t slot, uint8_t count) {
    const sbus::SlotTimer::OtherCoreLock lock;
    schedule().stop(slot, count);
  }

  /// Returns how many slots have been sent since begin().
  uint32_t sentSlots() const { return schedule().sent(); }

  /// Returns how many slots have been skipped since begin(), because their time was not known or had passed.
  uint32_t skippedSlots() const { return schedule().skipped(); }

  /// Returns how often since begin() something other than the answers came back: another sensor has the same slot, or
  /// the line was disturbed. Each time the sensor then only listens for a while, 16 to 1024 frames. If RX does not hear
  /// TX, as on a single wire, it counts only what RX hears in addition: another sensor that sends in the same slot at
  /// the same time goes unnoticed.
  uint32_t collisions() const { return schedule().collisions(); }

 private:
  friend class sbus::LinkQuality;  // for clock()

  template <typename Port>
  static bool start(Stream &stream, SBus2Sensor *sensor) {
    return sbus::SlotTimer::start(static_cast<Port &>(stream), due, sensor);
  }

  static constexpr int16_t NotSampled = -1;

  // The finder holds it, as what learns of each byte.
  sbus::SlotSchedule &schedule() { return _finder.events(); }
  const sbus::SlotSchedule &schedule() const { return _finder.events(); }

  void stop();
  void start(unsigned long baud);
  void onReceive();
  static void due(void *sensor);
  void receive(bool fromCallback);
  void plan(bool fromCallback);
  void answer(uint32_t now);
  void armTimer();
  void checkClock(bool isLate);
  void answerWithin(int32_t wait);
  void tick();
  int32_t untilDue() const;
  bool isLineIdle(uint32_t now);

  Stream &_stream;
  bool (*const _start)(Stream &stream, SBus2Sensor *sensor);
  bool _isTimed = false;     // a timer calls due()
  bool _cameAtOnce = false;  // the port's last call came at once
  bool _isLate = false;      // the next poll comes so late that its time says nothing
  sbus::SlotTimer::ClockCheck _clockCheck;
  sbus::FrameInterval _interval;
  uint32_t _heardBy = 0;          // us: no character that was read has come later
  int16_t _sampled = NotSampled;  // characters that waited shortly before the slot that is due
  uint32_t _timedFrame = 0;       // number of the last frame with a known end
  const sbus::ReceiveNotice _notice;
};

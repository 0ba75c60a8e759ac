// Sketches that use one piece of the library each: USE says which. size.sh compares each with USE_NOTHING.
#include <Arduino.h>

#if defined(USE_PIN)
#include <DecodeSBus.h>
#include <SBusPin.h>
#define USE_DECODER
SBusPin pin;
DecodeSBus receiver(pin);
#elif defined(USE_PAPERS)
#include "support/PaperDecoder.h"
PaperDecoder receiver(Serial1);
#elif defined(USE_EXTRA)
#include <DecodeSBus32.h>
#define USE_DECODER
DecodeSBus32 receiver(Serial1);
extern uint16_t *extra;
#elif defined(USE_DECODER) || defined(USE_ALL_OF_DECODER)
#include <DecodeSBus.h>
DecodeSBus receiver(Serial1);
#elif defined(USE_ENCODER)
#include <EncodeSBus.h>
EncodeSBus sender(Serial1);
#elif defined(USE_CHOICE)
#include <sbus/ReceiverChoice.h>
sbus::ReceiverChoice<2> choice;
extern sbus::Reception receptions[2];
#elif defined(USE_NORMALIZED)
#include <sbus/Scaling.h>
#elif defined(USE_CALIBRATOR)
#include <sbus/Calibrator.h>
sbus::Calibrator calibrator;
sbus::Calibration calibration;
#endif

// The compiler cannot see what happens to these.
extern uint16_t *channels;
extern bool *flags;
extern uint8_t *frame;

void setup() {
#if defined(USE_PAPERS) || defined(USE_DECODER) || defined(USE_ALL_OF_DECODER)
  receiver.begin();
#elif defined(USE_ENCODER)
  sender.begin();
#endif
}

void serialEvent1() {
#if defined(USE_PAPERS) || defined(USE_DECODER) || defined(USE_ALL_OF_DECODER)
  receiver.parseSBusFrame();
#endif
}

void loop() {
#if defined(USE_DECODER) || defined(USE_ALL_OF_DECODER)
  if (receiver.SBusFrameOk()) {
    receiver.decodeSBusFrame(channels, flags[0], flags[1]);
  }
#endif
#if defined(USE_EXTRA)
  flags[0] = receiver.decodeExtraChannels(extra);
#endif
#if defined(USE_ALL_OF_DECODER)
  receiver.end();
  receiver.begin(channels[0], frame[0]);
  receiver.setTimeout(channels[0]);
  receiver.setLossLimit(channels[1]);
  flags[0] = receiver.newFrame();
  channels[0] = static_cast<uint16_t>(receiver.linkState());
  channels[1] = static_cast<uint16_t>(receiver.frameAge());
  channels[2] = static_cast<uint16_t>(receiver.counters().resyncs);
#elif defined(USE_ENCODER)
  flags[0] = sender.write(channels, flags[0], flags[1]);
#elif defined(USE_CHOICE)
  channels[0] = choice.choose(receptions, channels[1]);
#elif defined(USE_NORMALIZED)
  channels[0] = static_cast<uint16_t>(sbus::toNormalized(channels[1], sbus::FrSky));
#elif defined(USE_CALIBRATOR)
  calibrator.begin();
  calibrator.feed(channels, flags[0], flags[1]);
  calibrator.centre();
  calibrator.high();
  flags[0] = calibrator.finish(channels[0], calibration, frame[0]) == sbus::CalibrationError::None;
#endif
}

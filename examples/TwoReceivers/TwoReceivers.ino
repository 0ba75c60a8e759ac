/*
  TwoReceivers: the better one of two receivers flies, and S.Bus goes on to a flight controller or to S.Bus servos.

  Wiring (Tlera Grasshopper): first receiver S.Bus -> D0 (RX1), second S.Bus -> A3 (RX2), GND -> GND
    A2 (TX2) -> the S.Bus input of the next device, GND -> its GND
    Uno R3, Nano: first -> 7, second -> inverter -> 0, 1 -> inverter -> the next device
    Other boards, what to set on the receivers, and a test on the ground: extras/docs/two-receivers.md

  A receiver in failsafe, or without a frame for 100 ms, is left at once, and one that loses all frames after 0.2 s. The
  first one flies again when it has been good for a second. When both are lost, frames go out with the failsafe flag.
  Sends over USB, once a second and at each change, who flies, how often that has changed, and how both receive. An Uno
  has no port left for that: its LED is lit while the second one flies.
*/

#define SBUS_MAY_TAKE_USB

#include <DecodeSBus.h>
#include <EncodeSBus.h>
#include <SBusBoard.h>
#include <sbus/LinkQuality.h>
#include <sbus/ReceiverChoice.h>

#if !defined(SBUS_SECOND_UART)
#error "TwoReceivers needs a second port that receives: extras/docs/two-receivers.md, Boards"
#define SBUS_SECOND_UART SBUS_UART
#endif

DecodeSBus first(SBUS_UART);  // this board's ports: extras/docs/two-receivers.md
DecodeSBus second(SBUS_SECOND_UART);
EncodeSBus output(SBUS_SECOND_UART);
DecodeSBus *const receivers[] = {&first, &second};

const uint16_t CLOSED = sbus::FrSky.low;    // CH3 at -100 %; Futaba: sbus::Futaba.low
const unsigned long PERIOD = 6000;          // us; the fastest receivers send as often
const unsigned long PERIOD_DISPLAY = 1000;  // ms

SBusFrame frames[2];
sbus::Reception receptions[2];
sbus::LinkQuality qualities[2];
sbus::ReceiverChoice<2> choice;
bool isOther[2];  // sends the range of the other make: its sticks would jump
bool isDue;       // a frame has come that has not been sent

#if SBUS_SECOND_TAKES_USB
void beginTelling() { pinMode(LED_BUILTIN, OUTPUT); }
void tell() { digitalWrite(LED_BUILTIN, choice.flying() == 1 ? HIGH : LOW); }
#else
const char *const STATES[] = {"never seen", "ok", "lossy", "failsafe", "stale"};

// Returns why a receiver is not used though something comes from it.
const char *fault(uint8_t i) {
  const sbus::Counters counters = receivers[i]->counters();
  return isOther[i]                      ? ", has the other make's range"
         : counters.frames != 0          ? ""
         : counters.otherSizeFrames != 0 ? ", sends 24 channels: set it to 16"
         : counters.discardedBytes != 0  ? ", no frames: the example Diagnose says why"
                                         : "";
}

void beginTelling() { Serial.begin(115200); }
void tell() {
  Serial.print(choice.flying() == 0 ? "first flies, " : "second flies, ");
  Serial.print(choice.changes());
  Serial.print(" changes");
  for (uint8_t i = 0; i < 2; i++) {
    Serial.print(i == 0 ? "; first: " : "; second: ");
    Serial.print(STATES[static_cast<uint8_t>(receptions[i].state)]);
    Serial.print(' ');
    Serial.print(receptions[i].quality);
    Serial.print(" %");
    Serial.print(fault(i));
  }
  Serial.println();
}
#endif

void setup() {
  beginTelling();
  first.begin();
  second.begin();  // opens the port both ways, also for `output`
  output.setPeriod(PERIOD);
}

void loop() {
  const uint8_t before = choice.flying();
  for (uint8_t i = 0; i < 2; i++) {
    DecodeSBus &receiver = *receivers[i];
    if (receiver.read(frames[i])) {
      isDue = isDue || i == before;
      isOther[i] = sbus::haveOtherRanges(frames[i].channels, frames[before].channels);
    }
    receptions[i] = {isOther[i] ? sbus::LinkState::NeverSeen : receiver.linkState(), frames[i].age,
                     qualities[i].update(receiver)};
  }
  const uint8_t flying = choice.choose(receptions, millis());
  const sbus::LinkState state = receptions[flying].state;
  SBusFrame frame = frames[flying];
  if (!receptions[flying].isUsable()) {
    frame.failsafe = true;
    if (state != sbus::LinkState::Failsafe) {  // stale
      frame.lostFrame = true;
      frame.channels[2] = CLOSED;  // for devices that ignore the flags
    }
  }
  isDue = isDue || flying != before || frame.failsafe;
  if (isDue && state != sbus::LinkState::NeverSeen && output.write(frame)) {
    isDue = false;
  }

  static uint32_t shown = 0;
  const uint32_t now = millis();
  if (flying != before || now - shown >= PERIOD_DISPLAY) {
    shown = now;
    tell();
  }
}

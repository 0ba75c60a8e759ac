/*
  Trainer: a teacher hands channels to a pupil, who has a radio and a receiver of his own, and takes them back.

  Wiring (Tlera Grasshopper): teacher's receiver S.Bus -> D0 (RX1), pupil's S.Bus -> A3 (RX2), GND -> GND
    A2 (TX2) -> the S.Bus input of the next device, GND -> its GND
    Uno R3, Nano: teacher -> 7, pupil -> inverter -> 0, 1 -> inverter -> the next device
    Other boards, what to set on the receivers, and a test on the ground: extras/docs/two-receivers.md

  While CH5 of the teacher is on, CH1 to CH4 are the pupil's. All other channels and the flags are always the teacher's.
  A pupil who is lost gives the channels back at once; a teacher who is lost is failsafe, whatever the pupil does.
  Sends "teacher" or "pupil" over USB at each change. An Uno has no port left for that: its LED is lit while the pupil
  flies.
*/

#define SBUS_MAY_TAKE_USB

#include <DecodeSBus.h>
#include <EncodeSBus.h>
#include <SBusBoard.h>
#include <sbus/Trainer.h>

#if !defined(SBUS_SECOND_UART)
#error "Trainer needs a second port that receives: extras/docs/two-receivers.md, Boards"
#define SBUS_SECOND_UART SBUS_UART
#endif

DecodeSBus teacher(SBUS_UART);  // this board's ports: extras/docs/two-receivers.md
DecodeSBus pupil(SBUS_SECOND_UART);
EncodeSBus output(SBUS_SECOND_UART);

const uint8_t SWITCH = 4;                 // CH5, counted from 0
const uint16_t CHANNELS = 0x000F;         // CH1 to CH4, one bit each
const uint16_t CLOSED = sbus::FrSky.low;  // CH3 at -100 %; Futaba: sbus::Futaba.low
const unsigned long PERIOD = 6000;        // us; the fastest receivers send as often

sbus::Trainer trainer(SWITCH, CHANNELS, sbus::FrSky);
SBusFrame teachers, pupils;
bool isDue;    // a frame of the teacher has come that has not been sent
bool isOther;  // the pupil's receiver sends the range of the other make: the sticks would jump
bool isPupils;

void tell() {
#if SBUS_SECOND_TAKES_USB
  digitalWrite(LED_BUILTIN, isPupils ? HIGH : LOW);
#else
  Serial.println(isPupils ? "pupil" : "teacher");
#endif
}

void setup() {
#if SBUS_SECOND_TAKES_USB
  pinMode(LED_BUILTIN, OUTPUT);
#else
  Serial.begin(115200);
#endif
  teacher.begin();
  pupil.begin();  // opens the port both ways, also for `output`
  output.setPeriod(PERIOD);
  tell();
}

void loop() {
  isDue = teacher.read(teachers) || isDue || teachers.failsafe;
  if (pupil.read(pupils)) {
    isOther = sbus::haveOtherRanges(teachers.channels, pupils.channels);
  }
  trainer.hear({isOther ? sbus::LinkState::NeverSeen : pupil.linkState(), pupils.age, 0}, millis());

  const sbus::Reception teachersReception = {teacher.linkState(), teachers.age, 0};
  SBusFrame frame = teachers;
  const bool wasPupils = isPupils;
  isPupils = trainer.train(frame.channels, teachersReception, pupils.channels);
  if (teachersReception.state == sbus::LinkState::Stale) {
    frame.failsafe = frame.lostFrame = true;
    frame.channels[2] = CLOSED;  // for devices that ignore the flags
  }
  if (isDue && teachersReception.state != sbus::LinkState::NeverSeen && output.write(frame)) {
    isDue = false;
  }
  if (isPupils != wasPupils) {
    tell();
  }
}

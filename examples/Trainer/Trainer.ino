/*
  Trainer: a teacher hands channels to a pupil, who has a radio and a receiver of his own, and takes them back.

  Wiring (Tlera Grasshopper): teacher's receiver S.Bus -> D0 (RX1), pupil's S.Bus -> A3 (RX2), GND -> GND
    A2 (TX2) -> the S.Bus input of the next device, GND -> its GND
    Other boards, what to set on the receivers, and a test on the ground: extras/docs/two-receivers.md

  While CH5 of the teacher is on, CH1 to CH4 are the pupil's. All other channels and the flags are always the teacher's. A
  pupil who is lost gives the channels back at once; a teacher who is lost is failsafe, whatever the pupil does.
  Sends "teacher" or "pupil" over USB at each change.
*/

#include <DecodeSBus.h>
#include <EncodeSBus.h>
#include <SBusUart.h>
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
bool isDue;  // a frame of the teacher has come that has not been sent
bool isPupils;

void setup() {
  Serial.begin(115200);
  teacher.begin();
  pupil.begin();  // opens the port both ways, also for `output`
  output.setPeriod(PERIOD);
  Serial.println("teacher");
}

void loop() {
  isDue = teacher.read(teachers) || isDue || teachers.failsafe;
  pupil.read(pupils);
  sbus::Reception pupilsReception = {pupil.linkState(), pupils.age, 0};
  if (sbus::haveOtherRanges(teachers.channels, pupils.channels)) {
    pupilsReception.state = sbus::LinkState::NeverSeen;  // the sticks would jump
  }
  trainer.hear(pupilsReception, millis());

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
    Serial.println(isPupils ? "pupil" : "teacher");
  }
}

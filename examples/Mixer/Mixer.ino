/*
  Mixer: reads a receiver, mixes, and sends S.Bus to a flight controller or to S.Bus servos.

  Wiring (Tlera Grasshopper, FrSky R-XSR): S-BUS_OUT -> D0 (RX1), +5V -> VIN, GND -> GND
    D1 (TX1) -> the S.Bus input of the next device, GND -> its GND

  For a flying wing: it turns aileron (CH1) and elevator (CH2) into the left and the right elevon. All other channels
  and both flags are sent unchanged. When no frame has come for 100 ms, it sets both flags and closes the throttle.
  Sends "aileron,elevator,left,right" over USB five times a second, each -1000..+1000.
*/

#include <DecodeSBus.h>
#include <EncodeSBus.h>
#include <SBusBoard.h>
#include <elapsedMillis.h>
#include <sbus/Scaling.h>

DecodeSBus dSBus(SBUS_UART);  // this board's port, on most boards Serial1: extras/docs/boards.md
EncodeSBus eSBus(SBUS_UART);  // another port needs eSBus.begin()

const unsigned long PERIOD_DISPLAY = 200;  // ms

uint16_t in[18];
bool failsafe, lostFrame;
elapsedMillis timerDisplay;

void setup() {
  Serial.begin(115200);
  dSBus.begin();  // opens the port both ways
}

void loop() {
  dSBus.parseSBusFrame();
  if (dSBus.linkState() == sbus::LinkState::NeverSeen) {
    return;  // no frame yet
  }
  dSBus.decodeSBusFrame(in, failsafe, lostFrame);  // on a stale link `in` stays, and both flags are set
  const int16_t aileron = sbus::toNormalized(in[0], sbus::FrSky);
  const int16_t elevator = sbus::toNormalized(in[1], sbus::FrSky);
  const int16_t elevons[] = {sbus::limited(elevator + aileron, -1000, 1000),
                             sbus::limited(elevator - aileron, -1000, 1000)};
  uint16_t out[18];
  memcpy(out, in, sizeof out);
  out[0] = sbus::fromNormalized(elevons[0], sbus::FrSky);
  out[1] = sbus::fromNormalized(elevons[1], sbus::FrSky);
  if (dSBus.linkState() == sbus::LinkState::Stale) {
    failsafe = lostFrame = true;  // it may have become stale since decodeSBusFrame()
    out[2] = sbus::FrSky.low;     // link lost: closes the throttle for receivers of this line that ignore the flags
  }
  eSBus.write(out, failsafe, lostFrame);

  if (timerDisplay >= PERIOD_DISPLAY) {
    timerDisplay = 0;
    const int16_t values[] = {aileron, elevator, elevons[0], elevons[1]};
    for (int i = 0; i < 4; i++) {
      Serial.print(values[i]);
      Serial.print(i < 3 ? "," : "\r\n");
    }
  }
}

/*
  Loopback: checks a board and its wiring without any receiver.

  Wiring: a wire from TX1 to RX1 (Tlera Grasshopper: D1 to D0; Arduino Mega: 18 to 19), and nothing else on these pins.

  Sends a hundred frames, no two alike, and reads them back. Prints PASS, or what is wrong, over USB, and starts again.
*/

#include <DecodeSBus.h>
#include <EncodeSBus.h>
#include <SBusBoard.h>

DecodeSBus dSBus(SBUS_UART);  // this board's port, on most boards Serial1: extras/docs/boards.md
EncodeSBus eSBus(SBUS_UART);

const uint16_t FRAMES = 100;
const uint32_t PATIENCE = 50;  // ms, to wait for the last frame to come back

uint16_t sent, right, wrong;
uint32_t sentTime;

// Frame number n: CH1 is the number, and all other channels follow from it. CH17 equals failsafe, and CH18 lost frame.
void fill(uint16_t channels[], uint16_t n) {
  for (uint8_t i = 0; i < 16; i++) {
    channels[i] = static_cast<uint16_t>((n + 131 * i) % 2048);
  }
  channels[16] = n & 1;
  channels[17] = n >> 1 & 1;
}

void setup() {
  Serial.begin(115200);
  dSBus.begin();  // opens the port both ways
}

void loop() {
  dSBus.parseSBusFrame();
  uint16_t channels[18], expected[18];
  bool failsafe, lostFrame;
  fill(channels, sent);
  if (sent < FRAMES && eSBus.write(channels, channels[16], channels[17])) {
    sent++;
    sentTime = millis();
  }
  if (dSBus.newFrame()) {
    dSBus.decodeSBusFrame(channels, failsafe, lostFrame);
    fill(expected, channels[0]);
    const bool same = memcmp(channels, expected, sizeof channels) == 0;
    ++(same && failsafe == expected[16] && lostFrame == expected[17] ? right : wrong);
  }
  if (sent == FRAMES && static_cast<uint32_t>(millis()) - sentTime > PATIENCE) {
    const bool any = dSBus.counters().frames != 0 || dSBus.counters().discardedBytes != 0;
    Serial.println(!any             ? "FAIL: not a byte comes back. Is TX1 connected to RX1? Are these the pins?"
                   : wrong != 0     ? "FAIL: frames come that were not sent. Is a receiver still connected to RX1?"
                   : right < FRAMES ? "FAIL: frames are damaged. Is the wire loose, or something else connected?"
                                    : "PASS: 100 frames sent, 100 came back right.");
    sent = right = wrong = 0;
    dSBus.begin();
  }
}

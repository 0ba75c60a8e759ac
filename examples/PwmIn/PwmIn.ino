/*
  PwmIn: turns four servo outputs of an old receiver into S.Bus, for a flight controller or S.Bus servos.

  Wiring (Tlera Grasshopper): D2..D5 (Mega: 2, 3, 20, 21) <- the signal wires of CH1..CH4, GND -> GND. A receiver at 5 V
    needs 1 kOhm and 2 kOhm as a divider before each pin of a board that does not tolerate 5 V.
    D1 (TX1; Mega: 18, and an inverter) -> the S.Bus input of the next device

  Each pin's interrupt measures its pulses. A pulse that is not 800..2200 us long, or has a spike in it, is rejected,
  and its channel holds. When a channel has had no pulse for 60 ms, frames have the lost-frame flag; after 300 ms also
  the failsafe flag, and the throttle closes. Nothing is sent until each channel has come once. (If a receiver goes on
  sending pulses without its radio, the sketch cannot notice: set its failsafe to a closed throttle.) CH5 and up are
  centred. Sends "CH1,CH2,CH3,CH4,lostFrame,failsafe" over USB five times a second: us, 0 before the first pulse, and
  flags.
*/

#include <EncodeSBus.h>
#include <SBusBoard.h>
#include <elapsedMillis.h>
#include <sbus/Scaling.h>

#include "PulseInput.h"

#if !defined(IRAM_ATTR)
#define IRAM_ATTR  // an ESP8266 demands it of interrupts; what they call lies in flash, and waits while that is written
#endif

EncodeSBus eSBus(SBUS_UART);  // this board's port, on most boards Serial1: extras/docs/boards.md
#if defined(__AVR_ATmega32U4__) || defined(__AVR_ATmega328P__) || defined(__AVR_ATmega168__)
#error "PwmIn needs four pins with interrupts; this board has fewer: extras/docs/examples.md names other boards"
#endif
#if defined(__AVR_ATmega2560__)
const uint8_t PINS[] = {2, 3, 20, 21};
#else
const uint8_t PINS[] = {SBUS_FREE_PINS};  // pins with interrupts
#endif

const uint8_t INPUTS = 4;
const uint8_t THROTTLE = 2;                // CH3, counted from 0
const uint32_t LOST = 60000;               // us: two pulses are missing
const uint32_t FAILSAFE = 300000;          // us
const unsigned long PERIOD_DISPLAY = 200;  // ms

PulseInput inputs[INPUTS];
uint16_t widths[INPUTS];  // us
uint16_t channels[18];
elapsedMillis timerDisplay;

// Called when this pin has changed.
void IRAM_ATTR changed(uint8_t input) {
  const uint32_t now = micros();
  bool isHigh[INPUTS];
  for (uint8_t i = 0; i < INPUTS; i++) {
    isHigh[i] = digitalRead(PINS[i]) == HIGH;  // all pins at once
  }
  for (uint8_t i = 0; i < INPUTS; i++) {
    inputs[i].look(isHigh[i], now, i == input);
  }
}
void IRAM_ATTR changed0() { changed(0); }
void IRAM_ATTR changed1() { changed(1); }
void IRAM_ATTR changed2() { changed(2); }
void IRAM_ATTR changed3() { changed(3); }

void attach(uint8_t pin, void (*callback)()) {
  pinMode(pin, INPUT);
  const int number = digitalPinToInterrupt(pin);
  if (number < 0) {
    Serial.print("Choose another pin, one that has an interrupt, instead of ");
    Serial.println(pin);
    return;
  }
  attachInterrupt(static_cast<uint8_t>(number), callback, CHANGE);
}

void setup() {
  Serial.begin(115200);
  eSBus.begin();
  for (uint8_t i = 0; i < 16; i++) {
    channels[i] = sbus::FrSky.centre;
  }
  attach(PINS[0], changed0);
  attach(PINS[1], changed1);
  attach(PINS[2], changed2);
  attach(PINS[3], changed3);
}

void loop() {
  bool haveCome = true, lostFrame = false, failsafe = false;
  for (uint8_t i = 0; i < INPUTS; i++) {
    noInterrupts();
    inputs[i].update(micros());  // the clock is read here: an interrupt must not come in between
    const uint32_t age = inputs[i].age();
    widths[i] = inputs[i].width();
    interrupts();
    haveCome = haveCome && widths[i] != 0;
    lostFrame = lostFrame || age >= LOST;
    failsafe = failsafe || age >= FAILSAFE;
    channels[i] = sbus::fromMicroseconds(static_cast<int16_t>(widths[i]), sbus::FrSky);
  }
  if (failsafe) {
    channels[THROTTLE] = sbus::FrSky.low;
  }
  if (haveCome) {
    eSBus.write(channels, failsafe, lostFrame);
  }
  if (timerDisplay >= PERIOD_DISPLAY) {
    timerDisplay = 0;
    for (uint8_t i = 0; i < INPUTS; i++) {
      Serial.print(widths[i]);
      Serial.print(',');
    }
    Serial.print(lostFrame ? 1 : 0);
    Serial.print(',');
    Serial.println(failsafe ? 1 : 0);
  }
}

// What the rules of two receivers cost. (No .ino, as Background.cpp.) Sends once
//   choose,ranges,quality,train
// in cycles a call: ReceiverChoice::choose(), haveOtherRanges(), LinkQuality::update(), Trainer::train() of four
// channels.

#include <Arduino.h>
#include <sbus/LinkQuality.h>
#include <sbus/ReceiverChoice.h>
#include <sbus/Trainer.h>

namespace {

constexpr uint8_t Calls = 16;

sbus::ReceiverChoice<2> choice;
sbus::Trainer trainer(7, 0x000F, sbus::FrSky);
sbus::LinkQuality quality;
SBusFrame one, other;
sbus::Reception receptions[2] = {{sbus::LinkState::Ok, 3, 100}, {sbus::LinkState::Ok, 5, 98}};
sbus::Counters counters = {};
volatile uint8_t result;

// Prints how many cycles one call takes, without those of the loop.
template <typename Work>
void measure(const Work &work) {
  noInterrupts();
  TCNT1 = 0;
  for (uint8_t i = 0; i < Calls; i++) {
    result = i;
  }
  const uint16_t empty = TCNT1;
  TCNT1 = 0;
  for (uint8_t i = 0; i < Calls; i++) {
    result = work(i);
  }
  const uint16_t all = TCNT1;
  interrupts();
  Serial.print((all - empty) / Calls);
}

}  // namespace

void setup() {
  Serial.begin(115200);
  TCCR1A = 0;
  TCCR1B = 1;  // counts cycles
  for (uint8_t i = 0; i < 16; i++) {
    one.channels[i] = other.channels[i] = 992;
  }
  one.channels[7] = 1811;
  trainer.hear(receptions[1], 1);
  measure([](uint8_t i) { return choice.choose(receptions, 5000u + i); });
  Serial.print(',');
  measure([](uint8_t) { return sbus::haveOtherRanges(one.channels, other.channels); });
  Serial.print(',');
  measure([](uint8_t i) {
    counters.frames += 100;
    return quality.update(counters, sbus::LinkState::Ok, 5000000u + i * 250000u);
  });
  Serial.print(',');
  measure([](uint8_t) { return trainer.train(one.channels, receptions[0], other.channels); });
  Serial.println();
}

void loop() {}

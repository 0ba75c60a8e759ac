// The libraries that come with the board's core, built on host::Board.

#include <algorithm>

#include "board/Board.h"
#include "EEPROM.h"
#include "PinDescription.h"
#include "Servo.h"
#include "stm32l0_servo.h"

using host::Board;

EEPROMClass EEPROM;
static_assert(EEPROMClass::length() == host::Eeprom::Size, "the sketch must see the real size");

uint8_t host::readEeprom(int address) { return Board::instance().eeprom().read(address); }

void host::writeEeprom(int address, const uint8_t *bytes, size_t size) {
  Board &board = Board::instance();
  board.spend(board.eeprom().write(address, bytes, size));
}

namespace {

constexpr int Degrees = 180;  // a servo's travel

}  // namespace

uint8_t Servo::attach(int pin, int min, int max) {
  _pin = pin;
  _min = min;
  _max = max;
  Board::instance().pins().attachServo(static_cast<uint32_t>(pin));
  return static_cast<uint8_t>(pin);
}

void Servo::write(int value) {
  writeMicroseconds(value >= MIN_PULSE_WIDTH ? value : _min + (_max - _min) * std::clamp(value, 0, Degrees) / Degrees);
}

void Servo::writeMicroseconds(int us) {
  _us = std::max(_min, std::min(us, _max));
  if (attached()) {
    Board::instance().pins().use(host::Pins::Servo, static_cast<uint32_t>(_pin), _us);
  }
}

// Rounds, so that read() returns the value passed to write().
int Servo::read() { return _max > _min ? ((_us - _min) * Degrees + (_max - _min) / 2) / (_max - _min) : 0; }

static_assert(PINS_COUNT == 26, "the pins listed here");
const PinDescription g_APinDescription[PINS_COUNT] = {{0},  {1},  {2},  {3},  {4},  {5},  {6},  {7},  {8},
                                                      {9},  {10}, {11}, {12}, {13}, {14}, {15}, {16}, {17},
                                                      {18}, {19}, {20}, {21}, {22}, {23}, {24}, {25}};

bool stm32l0_timer_create(stm32l0_timer_t *timer, unsigned instance, unsigned, unsigned) {
  timer->instance = instance;
  return true;
}

bool stm32l0_servo_create(stm32l0_servo_t *servo, stm32l0_timer_t *) {
  servo->state = STM32L0_SERVO_STATE_INIT;
  return true;
}

bool stm32l0_servo_enable(stm32l0_servo_t *servo, const stm32l0_servo_table_t *table, stm32l0_servo_event_callback_t,
                          void *) {
  if (servo->state != STM32L0_SERVO_STATE_INIT) {
    return false;
  }
  servo->state = STM32L0_SERVO_STATE_ACTIVE;
  return stm32l0_servo_configure(servo, table);
}

bool stm32l0_servo_configure(stm32l0_servo_t *servo, const stm32l0_servo_table_t *table) {
  if (servo->state != STM32L0_SERVO_STATE_ACTIVE) {
    return false;
  }
  for (uint32_t i = 0; i < table->entries; i++) {
    const auto &slot = table->slot[i];
    if (i >= servo->set.entries || slot.pin != servo->set.slot[i].pin || slot.width != servo->set.slot[i].width) {
      Board::instance().pins().use(host::Pins::Servo, slot.pin, slot.width);
    }
  }
  servo->set = *table;
  return true;
}

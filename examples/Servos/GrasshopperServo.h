// Class Servo for the Grasshopper, like Arduino's library of that name, which does not support the STM32L0: up to ten
// servos, one pulse after the other, every 20 ms (ten of the longest: 24 ms). The core's own driver makes them, with
// TIM7.
#pragma once

#include <Arduino.h>
#include <stm32l0_servo.h>

class Servo {
 public:
  // Sets the length of the next pulses in us, clamped to 544..2400 as by Arduino's library. It may precede attach().
  void writeMicroseconds(int us) {
    const uint16_t clamped = static_cast<uint16_t>(us < 544 ? 544 : us > 2400 ? 2400 : us);
    if (clamped != _us) {
      _us = clamped;
      update();
    }
  }

  // Starts pulses of 1500 us. Returns false if there are ten servos already, or no such pin.
  bool attach(int pin) {
    if (_slot < 0 && table().entries < STM32L0_SERVO_SLOT_COUNT && pin >= 0 && pin < static_cast<int>(PINS_COUNT)) {
      _slot = static_cast<int>(table().entries++);
      table().slot[_slot].pin = g_APinDescription[pin].pin;
      update();
      if (_slot == 0) {
        delay(3);  // hides the driver's first pulse, which has 47 us before its prescaler is loaded
      }
      pinMode(static_cast<uint32_t>(pin), OUTPUT);
    }
    return _slot >= 0;
  }

 private:
  static stm32l0_servo_table_t &table() {  // pins and pulses, which the driver reads; all servos share it
    static stm32l0_servo_table_t all;
    return all;
  }

  void update() {
    static stm32l0_timer_t timer;
    static stm32l0_servo_t driver;
    if (_slot < 0) {
      return;
    }
    table().slot[_slot].width = _us;
    if (driver.state == STM32L0_SERVO_STATE_NONE) {
      stm32l0_timer_create(&timer, STM32L0_TIMER_INSTANCE_TIM7, 0, 0);
      stm32l0_servo_create(&driver, &timer);
      stm32l0_servo_enable(&driver, &table(), nullptr, nullptr);
    } else {
      stm32l0_servo_configure(&driver, &table());
    }
  }

  int _slot = -1;
  uint16_t _us = 1500;
};

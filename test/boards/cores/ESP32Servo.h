// The library ESP32Servo, of the Library Manager.
#pragma once
#include "../../../extras/host/arduino/Servo.h"

// github.com/espressif/arduino-esp32: cores/esp32/HardwareSerial.h and .cpp, esp32-hal-uart.c. ESP32_CORE is
//   1  1.0.6 (3691149)
//   3  2.0.17 and 3.0.0, whose lines stand below; a later 3.x with UART_SCLK_REF_TICK restarts its driver in the same
//   way
// Characters with errors are kept: core 1 asks for no error (esp32-hal-uart.c, _uart_isr()), IDF only reports them
// (v5.1.4, driver/uart/uart.c:995). Before 2.0.6 120 characters at once were 112.
#pragma once

#include "../Stream.h"

#define ESP32
#define ARDUINO_ARCH_ESP32
#define EEPROM_EMULATED
#if ESP32_CORE != 1
#define ESP_ARDUINO_VERSION_MAJOR 3
#endif
#if ESP32_CORE == 1
#define SERIAL_8N1 0x800001c
#define SERIAL_8E1 0x800001e
#define SERIAL_8E2 0x800003e
#else
enum SerialConfig { SERIAL_8N1 = 0x800001c, SERIAL_8E1 = 0x800001e, SERIAL_8E2 = 0x800003e };
#endif
#define PINS_GIVEN 16, 17
#if !defined(CONFIG_IDF_TARGET_ESP32C3) && !defined(CONFIG_IDF_TARGET_ESP32C6) && \
    !defined(CONFIG_IDF_TARGET_ESP32H2) && !defined(CONFIG_IDF_TARGET_ESP32P4) && \
    !defined(CONFIG_IDF_TARGET_ESP32S2) && !defined(CONFIG_IDF_TARGET_ESP32S3)
#define CONFIG_IDF_TARGET_ESP32 1
#endif

class HardwareSerial : public Simulated<Stream> {
 public:
  HardwareSerial()
      : Simulated<Stream>({256, Burst, 2, 128, sim::NoBaud, false, 0}, ESP32_CORE == 1 ? sim::Newest : sim::Fifo) {}

  void begin(unsigned long baud, uint32_t config = SERIAL_8N1, int8_t rx = -1, int8_t tx = -1, bool invert = false,
             unsigned long = 20000, uint8_t = 120) {
    const sim::Settings settings = {baud, sim::evenStops<uint32_t>(config, SERIAL_8E1, SERIAL_8E2), invert, invert};
    // Core 1: HardwareSerial.cpp:59.
    const bool installed = uart.isOpen() && ESP32_CORE != 1;
    if (!installed && rx < 0 && tx < 0) {  // :296
      rx = _rx < 0 || ESP32_CORE == 1 ? RX1 : _rx;
    }
    if (installed && invert == uart.settings().rxInverted) {  // :424
      uart.change(settings);
      if (rx > 0 && rx != _rx) {
        attach(rx);
      }
      return;
    }
    if (installed) {
      attach(-1);  // uartEnd(), :425 and :116
    }
    uart.open(settings);
    uart.setBurst(Burst);
    if (rx >= 0 && (rx != _rx || ESP32_CORE == 1)) {  // uartSetPins(), :325 and :552
      attach(rx);
    }
  }

  void end() {                                    // :400
    ESP32_CORE == 3 ? uart.cut() : uart.close();  // uartEnd() detaches the pins at once
    attach(-1);
  }

  unsigned setRxBufferSize(unsigned size) {  // their size_t has 32 bits
    if (uart.isOpen() != (ESP32_CORE == 1)) {
      return 0;
    }
    if (ESP32_CORE == 1) {
      uart.open(uart.settings());  // its queue is a new one (uartResizeRxBuffer())
    }
    uart.setBuffer(size);
    return size;
  }

#if ESP32_CORE == 1
  operator bool() const { return true; }
#else
  operator bool() const { return uart.isOpen(); }
  // These take a mutex, which nothing may without interrupts (esp32-hal-uart.c, UART_MUTEX_LOCK()).
  int available() override { return locked().available(); }
  int peek() override { return locked().peek(); }
  int read() override { return locked().read(); }
  size_t write(uint8_t byte) override { return locked().write(byte); }
  bool setRxFIFOFull(uint8_t characters) {
    if (uart.isOpen()) {
      uart.setBurst(characters);
    }
    return uart.isOpen();
  }
  bool setPins(int8_t rx, int8_t, int8_t = -1, int8_t = -1) {
    _rx = rx;
    attach(rx);
    return true;
  }
#endif

  using Simulated<Stream>::read;
  using Print::write;
  size_t read(uint8_t *buffer, size_t size) { return static_cast<size_t>(locked().read(buffer, size)); }
  int availableForWrite() override { return uart.room(); }

 protected:
  uint8_t _uart_nr = number();

 private:
  uint8_t number() const;
  sim::Uart &locked() {
    sim::inPort();
    return uart;
  }
  static constexpr int8_t RX1 = sim::CorePin;
  static constexpr unsigned Burst = ESP32_CORE == 1 ? 112 : 120;  // the driver's
  void attach(int8_t rx) {
    _rx = rx;
    uart.attach(rx);
  }
  int8_t _rx = -1;
};
extern HardwareSerial Serial1, Serial2;
inline uint8_t HardwareSerial::number() const { return this == &Serial1 ? 1 : 2; }

constexpr sim::Known Core = {true, 2, 0, true};

#define OPENED_BY_HAND
inline void openByHand() { Serial1.begin(100000, SERIAL_8E2, sim::CorePin, 17, true); }

// FreeRTOS as ESP-IDF has it (v5.1, components/freertos/FreeRTOS-Kernel), which arduino-esp32's Arduino.h brings in.
// What fails there with configASSERT() counts as a crash.
typedef int BaseType_t;
typedef unsigned UBaseType_t;
typedef uint32_t TickType_t;
typedef void (*TaskFunction_t)(void *);
typedef struct Task *TaskHandle_t;
typedef struct Queue *QueueHandle_t;

constexpr BaseType_t pdFALSE = 0, pdTRUE = 1, pdPASS = 1;
constexpr UBaseType_t configMAX_PRIORITIES = 25;
constexpr uint32_t configTICK_RATE_HZ = 1000;  // arduino-esp32's; ESP-IDF's own default is 100
constexpr TickType_t pdMS_TO_TICKS(uint32_t ms) {
  return static_cast<TickType_t>(uint64_t{ms} * configTICK_RATE_HZ / 1000);
}

BaseType_t xTaskCreatePinnedToCore(TaskFunction_t function, const char *name, uint32_t stackBytes, void *parameter,
                                   UBaseType_t priority, TaskHandle_t *task, BaseType_t core);
void vTaskDelay(TickType_t ticks);
void vTaskDelete(TaskHandle_t task);
BaseType_t xPortGetCoreID();

QueueHandle_t xQueueCreate(UBaseType_t length, UBaseType_t size);
BaseType_t xQueueOverwrite(QueueHandle_t queue, const void *item);
BaseType_t xQueueReceive(QueueHandle_t queue, void *item, TickType_t ticks);

#include "DmaSender.h"

#include "../sbus2/FrameEnd.h"

#if defined(SBUS_DMA_SENDER)

#include <stm32l0_dma.h>
#include <string.h>

extern const stm32l0_uart_params_t g_Serial1Params, g_Serial2Params, g_Serial3Params;  // variant.cpp

namespace sbus {

namespace {

constexpr uint32_t Options = STM32L0_DMA_OPTION_MEMORY_TO_PERIPHERAL | STM32L0_DMA_OPTION_PERIPHERAL_DATA_SIZE_8 |
                             STM32L0_DMA_OPTION_MEMORY_DATA_SIZE_8 | STM32L0_DMA_OPTION_MEMORY_DATA_INCREMENT |
                             STM32L0_DMA_OPTION_PRIORITY_MEDIUM;

// A UART of the chip. Each has two channels that can be its own.
struct Sender {
  USART_TypeDef *registers;
  uint16_t channels[2];
  uint16_t channel;  // 0: none yet
  uint8_t size;      // of what was given last
  uint8_t characters[DmaSender::Room];
};

Sender usart1 = {USART1, {STM32L0_DMA_CHANNEL_DMA1_CH2_USART1_TX, STM32L0_DMA_CHANNEL_DMA1_CH4_USART1_TX}, 0, 0, {}};
Sender usart2 = {USART2, {STM32L0_DMA_CHANNEL_DMA1_CH7_USART2_TX, STM32L0_DMA_CHANNEL_DMA1_CH4_USART2_TX}, 0, 0, {}};
Sender lpuart1 = {
    LPUART1, {STM32L0_DMA_CHANNEL_DMA1_CH7_LPUART1_TX, STM32L0_DMA_CHANNEL_DMA1_CH2_LPUART1_TX}, 0, 0, {}};

const stm32l0_uart_params_t *settings(const HardwareSerial *port) {
  static_cast<void>(port);
#if SERIAL_INTERFACES_COUNT > 1
  if (port == &Serial1) {
    return &g_Serial1Params;
  }
#endif
#if SERIAL_INTERFACES_COUNT > 2
  if (port == &Serial2) {
    return &g_Serial2Params;
  }
#endif
#if SERIAL_INTERFACES_COUNT > 3
  if (port == &Serial3) {
    return &g_Serial3Params;
  }
#endif
  return nullptr;
}

Sender *senderOf(const HardwareSerial *port) {
  const stm32l0_uart_params_t *const found = settings(port);
  switch (found != nullptr ? int{found->instance} : -1) {
    case STM32L0_UART_INSTANCE_USART1:
      return &usart1;
    case STM32L0_UART_INSTANCE_USART2:
      return &usart2;
    case STM32L0_UART_INSTANCE_LPUART1:
      return &lpuart1;
    default:
      return nullptr;
  }
}

// Claims a channel. When the core enables one it also changes the request of the next one (stm32l0_dma.c:199, channel
// >> 4 has 8 bits): after USART1's that is the receiver's. So what was there is put back; and what begin() of the port
// that receives by the channel before did to ours, select() mends.
bool claim(uint16_t channel) {
  const uint32_t masked = __get_PRIMASK();
  __disable_irq();
  const uint32_t before = DMA1_CSELR->CSELR;
  const bool isOurs = stm32l0_dma_enable(channel, nullptr, nullptr);
  DMA1_CSELR->CSELR = before;
  __set_PRIMASK(masked);
  return isOurs;
}

void select(uint16_t channel) {
  const unsigned shift = ((channel & 7u) - STM32L0_DMA_CHANNEL_DMA1_CH1_INDEX) * 4;  // core 0.0.10 counts from 1
  const uint32_t masked = __get_PRIMASK();
  __disable_irq();
  DMA1_CSELR->CSELR = (DMA1_CSELR->CSELR & ~(15u << shift)) | ((channel >> 4 & 15u) << shift);
  __set_PRIMASK(masked);
}

bool hasChannel(Sender &sender) {
  for (uint8_t i = 0; sender.channel == 0 && i < 2; i++) {
    if (claim(sender.channels[i])) {
      sender.channel = sender.channels[i];
    }
  }
  return sender.channel != 0;
}

uint32_t addressOf(const volatile void *object) { return static_cast<uint32_t>(reinterpret_cast<uintptr_t>(object)); }

bool isOpen(const Sender &sender) { return (sender.registers->CR1 & USART_CR1_UE) != 0; }

// begin() clears the bit: what was left then is never sent.
bool isLinked(const Sender &sender) { return (sender.registers->CR3 & USART_CR3_DMAT) != 0; }

bool isBusy(const Sender &sender) {
  return isOpen(sender) && isLinked(sender) && sender.channel != 0 && stm32l0_dma_count(sender.channel) < sender.size;
}

size_t roomOf(Sender &sender) { return isOpen(sender) && !isBusy(sender) && hasChannel(sender) ? DmaSender::Room : 0; }

}  // namespace

bool DmaSender::knows(const HardwareSerial *port) { return senderOf(port) != nullptr; }

size_t DmaSender::room(const HardwareSerial *port) {
  Sender *const sender = senderOf(port);
  return sender != nullptr ? roomOf(*sender) : 0;
}

// Interrupts may come at any of these lines: the transfer has not begun, or needs none.
bool DmaSender::send(const HardwareSerial *port, const uint8_t *characters, size_t size) {
  Sender *const found = senderOf(port);
  if (found == nullptr || size > roomOf(*found)) {
    return false;
  }
  Sender &sender = *found;
  stm32l0_dma_stop(sender.channel);
  select(sender.channel);
  memcpy(sender.characters, characters, size);
  sender.size = static_cast<uint8_t>(size);
  stm32l0_dma_start(sender.channel, addressOf(&sender.registers->TDR), addressOf(sender.characters),
                    static_cast<uint16_t>(size), Options);
  armv6m_atomic_or(&sender.registers->CR3, USART_CR3_DMAT);
  return true;
}

bool DmaSender::cameAtOnce(const HardwareSerial *port) {
  const stm32l0_uart_params_t *const found = settings(port);
  return found != nullptr && found->rx_dma != STM32L0_DMA_CHANNEL_NONE &&
         stm32l0_dma_count(found->rx_dma) % HalfRing == 0;
}

bool DmaSender::hears(const HardwareSerial *port) {
  const Sender *const sender = senderOf(port);
  return sender != nullptr && (sender->registers->ISR & USART_ISR_BUSY) != 0;
}

void DmaSender::flush(const HardwareSerial *port) {
  const Sender *const sender = senderOf(port);
  if (sender == nullptr || sender->size == 0) {
    return;
  }
  while (isBusy(*sender) || (isOpen(*sender) && (sender->registers->ISR & USART_ISR_TC) == 0)) {
  }
}

}  // namespace sbus

#endif

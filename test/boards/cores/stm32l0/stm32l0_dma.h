// A stand-in of the STM32L0's DMA and UARTs, as DmaSender uses them: GrumpyOldPizza/ArduinoCore-stm32l0 b1cf1cd,
// system/STM32L0xx/Source/stm32l0_dma.c, stm32l0_uart.c. Only the transmitters send.
#pragma once

#include <stdint.h>

#include <vector>

struct USART_TypeDef {
  uint32_t CR1, CR3, ISR, TDR;
};
constexpr uint32_t USART_CR1_UE = 1, USART_CR3_DMAT = 0x80, USART_CR3_DMAR = 0x40, USART_ISR_TC = 0x40,
                   USART_ISR_BUSY = 0x10000;
#define DMA1_Channel2 1

namespace sim {

struct DmaChannel {
  uint16_t owner;  // 0xffff: free
  bool enabled;
  uint32_t memory;
  uint16_t left, size;
};
struct Dma {
  DmaChannel channels[7];
  struct Selection {
    uint32_t CSELR;
  } selection;
};
extern Dma dma;
extern USART_TypeDef usarts[3];  // USART1, USART2, LPUART1

// Lets each UART that is open and linked take up to `count` characters. Returns what they have sent.
std::vector<uint8_t> sent(unsigned count);

}  // namespace sim

#define USART1 (&sim::usarts[0])
#define USART2 (&sim::usarts[1])
#define LPUART1 (&sim::usarts[2])
#define DMA1_CSELR (&sim::dma.selection)

struct stm32l0_uart_params_t {
  uint8_t instance;
  uint16_t rx_dma;
};
constexpr uint16_t STM32L0_DMA_CHANNEL_NONE = 0;
enum { STM32L0_UART_INSTANCE_USART1, STM32L0_UART_INSTANCE_USART2, STM32L0_UART_INSTANCE_LPUART1 };
#define SERIAL_INTERFACES_COUNT 4

// stm32l0_dma.h:42, 58 ...: 0x0f, the request, the channel's index; in core 0.0.10 without 0x0f, and the index counts
// from 1.
#if defined(STM32L0_CORE_0_0)
#define STM32L0_DMA_CHANNEL_DMA1_CH1_INDEX 1
#else
#define STM32L0_DMA_CHANNEL_DMA1_CH1_INDEX 0
#endif
namespace sim {
constexpr uint16_t channelOf(unsigned number, unsigned request) {
  return static_cast<uint16_t>((STM32L0_DMA_CHANNEL_DMA1_CH1_INDEX != 0 ? 0 : 0x0f00) | request << 4 |
                               (number - 1 + STM32L0_DMA_CHANNEL_DMA1_CH1_INDEX));
}
}  // namespace sim
enum : uint16_t {
  STM32L0_DMA_CHANNEL_DMA1_CH2_USART1_TX = sim::channelOf(2, 3),
  STM32L0_DMA_CHANNEL_DMA1_CH4_USART1_TX = sim::channelOf(4, 3),
  STM32L0_DMA_CHANNEL_DMA1_CH4_USART2_TX = sim::channelOf(4, 4),
  STM32L0_DMA_CHANNEL_DMA1_CH7_USART2_TX = sim::channelOf(7, 4),
  STM32L0_DMA_CHANNEL_DMA1_CH2_LPUART1_TX = sim::channelOf(2, 5),
  STM32L0_DMA_CHANNEL_DMA1_CH7_LPUART1_TX = sim::channelOf(7, 5),
};
enum : uint32_t {
  STM32L0_DMA_OPTION_MEMORY_TO_PERIPHERAL = 1,
  STM32L0_DMA_OPTION_PERIPHERAL_DATA_SIZE_8 = 0,
  STM32L0_DMA_OPTION_MEMORY_DATA_SIZE_8 = 0,
  STM32L0_DMA_OPTION_MEMORY_DATA_INCREMENT = 2,
  STM32L0_DMA_OPTION_PRIORITY_MEDIUM = 4
};

bool stm32l0_dma_enable(uint16_t channel, void (*callback)(void *, uint32_t), void *context);
void stm32l0_dma_start(uint16_t channel, uint32_t to, uint32_t from, uint16_t count, uint32_t option);
uint16_t stm32l0_dma_stop(uint16_t channel);
uint16_t stm32l0_dma_count(uint16_t channel);
inline uint32_t armv6m_atomic_or(uint32_t *word, uint32_t bits) {
  const uint32_t before = *word;
  *word |= bits;
  return before;
}

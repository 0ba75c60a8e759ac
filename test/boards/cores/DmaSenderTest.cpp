// port/DmaSender on a stand-in of the STM32L0's registers: what is given goes out whole, and nothing else does.
#include <Arduino.h>
#include <doctest/doctest.h>
#include <stm32l0_dma.h>

#include <algorithm>

Uart Serial1, Serial2, Serial3;
extern const stm32l0_uart_params_t g_Serial1Params = {STM32L0_UART_INSTANCE_USART1, sim::channelOf(3, 3)},
                                   g_Serial2Params = {STM32L0_UART_INSTANCE_USART2, sim::channelOf(6, 4)},
                                   g_Serial3Params = {STM32L0_UART_INSTANCE_LPUART1, STM32L0_DMA_CHANNEL_NONE};

#include "port/Port.h"
// After Port.h, as for a sketch: the compiler must not see that flush() exists.
#include "port/DmaSender.cpp"

namespace sim {

Dma dma;
USART_TypeDef usarts[3];
bool timePasses = false;  // a character goes out each time somebody asks how many are left
std::vector<uint8_t> gone;

namespace {

constexpr uint16_t Free = 0xffff;
constexpr uint32_t Requests[] = {3, 4, 5};  // of the UARTs, in CSELR

void reset() {
  dma = Dma();
  timePasses = false;
  gone.clear();
  for (DmaChannel &channel : dma.channels) {
    channel.owner = Free;
  }
  for (USART_TypeDef &usart : usarts) {
    usart = {0, 0, USART_ISR_TC, 0};
  }
  sbus::usart1.channel = sbus::usart2.channel = sbus::lpuart1.channel = 0;
  sbus::usart1.size = sbus::usart2.size = sbus::lpuart1.size = 0;
}

unsigned indexOf(uint16_t channel) { return (channel & 7u) - STM32L0_DMA_CHANNEL_DMA1_CH1_INDEX; }

uint32_t requestOf(unsigned channel) { return dma.selection.CSELR >> (4 * channel) & 15; }

// Uart::begin(): ends the port first, sets all of CR3 (stm32l0_uart.c:905), and enables the receiver's channel.
void begin(unsigned uart) {
  constexpr uint16_t Receivers[] = {channelOf(3, 3), channelOf(6, 4), 0};
  usarts[uart].CR3 = 0;
  usarts[uart].CR1 = USART_CR1_UE;
  if (Receivers[uart] != 0) {
    dma.channels[indexOf(Receivers[uart])].owner = Free;
    stm32l0_dma_enable(Receivers[uart], nullptr, nullptr);
    usarts[uart].CR3 = USART_CR3_DMAR;
  }
}

// The UART to which a channel is linked, or null.
USART_TypeDef *usartOf(unsigned channel) {
  const auto found = std::find(std::begin(Requests), std::end(Requests), requestOf(channel));
  return found != std::end(Requests) ? &usarts[found - Requests] : nullptr;
}

// The objects of a program lie within 4 GB.
const uint8_t *at(uint32_t address) {
  const uintptr_t near = reinterpret_cast<uintptr_t>(&dma);
  return reinterpret_cast<const uint8_t *>((near & ~uintptr_t{UINT32_MAX}) | address);
}

}  // namespace

std::vector<uint8_t> sent(unsigned count) {
  std::vector<uint8_t> characters;
  for (unsigned uart = 0; uart < 3; uart++) {
    for (unsigned channel = 0; channel < 7; channel++) {
      DmaChannel &each = dma.channels[channel];
      const bool linked = (usarts[uart].CR1 & USART_CR1_UE) != 0 && (usarts[uart].CR3 & USART_CR3_DMAT) != 0;
      if (!linked || !each.enabled || requestOf(channel) != Requests[uart]) {
        continue;
      }
      for (unsigned i = 0; i < count && each.left > 0; i++, each.left--) {
        characters.push_back(*at(each.memory++));
      }
    }
  }
  return characters;
}

}  // namespace sim

// stm32l0_dma.c:181. Its modify() is an exclusive or, and the channel's upper bits reach the next channel's request.
bool stm32l0_dma_enable(uint16_t channel, void (*)(void *, uint32_t), void *) {
  sim::DmaChannel &dma = sim::dma.channels[sim::indexOf(channel)];
  if (dma.owner != sim::Free) {
    return false;
  }
  const unsigned shift = sim::indexOf(channel) << 2;
  dma.owner = channel;
  DMA1_CSELR->CSELR = (DMA1_CSELR->CSELR & ~(15u << shift)) ^ (uint32_t{channel} >> 4 << shift);
  return true;
}
// stm32l0_dma.c:236: the registers of a channel that is enabled do not change (RM0376, DMA_CNDTRx).
void stm32l0_dma_start(uint16_t channel, uint32_t, uint32_t from, uint16_t count, uint32_t) {
  sim::DmaChannel &dma = sim::dma.channels[sim::indexOf(channel)];
  dma.size = count;
  if (!dma.enabled) {
    dma.memory = from;
    dma.left = count;
  }
  dma.enabled = true;
  sim::usartOf(sim::indexOf(channel))->ISR &= ~USART_ISR_TC;
}
uint16_t stm32l0_dma_stop(uint16_t channel) {
  sim::dma.channels[sim::indexOf(channel)].enabled = false;
  return stm32l0_dma_count(channel);
}
// The last character goes out after it has left the memory.
uint16_t stm32l0_dma_count(uint16_t channel) {
  if (sim::timePasses) {
    if (sim::dma.channels[sim::indexOf(channel)].left == 0) {
      sim::usartOf(sim::indexOf(channel))->ISR |= USART_ISR_TC;
    }
    const std::vector<uint8_t> characters = sim::sent(1);
    sim::gone.insert(sim::gone.end(), characters.begin(), characters.end());
  }
  const sim::DmaChannel &dma = sim::dma.channels[sim::indexOf(channel)];
  return static_cast<uint16_t>(dma.size - dma.left);
}

namespace {

using Characters = std::vector<uint8_t>;
const Characters Slot = {0x03, 0xC0, 0x31}, Next = {0x83, 0x12, 0x34};

bool send(const Uart &port, const Characters &characters) {
  return sbus::DmaSender::send(&port, characters.data(), characters.size());
}

}  // namespace

TEST_CASE("what is given goes out whole; meanwhile there is no room, and nothing else is taken") {
  Uart *const ports[] = {&Serial1, &Serial2, &Serial3};
  for (unsigned uart = 0; uart < 3; uart++) {
    CAPTURE(uart);
    sim::reset();
    CHECK(sbus::DmaSender::room(ports[uart]) == 0);  // closed
    CHECK_FALSE(send(*ports[uart], Slot));
    sim::begin(uart);
    CHECK(sbus::DmaSender::room(ports[uart]) == 36);
    CHECK(send(*ports[uart], Slot));
    CHECK(sbus::DmaSender::room(ports[uart]) == 0);
    CHECK_FALSE(send(*ports[uart], Next));
    CHECK(sim::sent(1) == Characters{0x03});
    CHECK_FALSE(send(*ports[uart], Next));
    CHECK(sim::sent(99) == Characters{0xC0, 0x31});
    CHECK(sim::sent(99).empty());
    CHECK(send(*ports[uart], Next));
    CHECK(sim::sent(99) == Next);
  }
}

TEST_CASE("the receivers keep their requests, and the sender gets its own back after the core has changed it") {
  sim::reset();
  sim::begin(0);
  sim::begin(1);
  for (int i = 0; i < 4; i++) {
    const uint32_t first = sim::requestOf(2), second = sim::requestOf(5);
    CHECK(send(Serial1, Slot));
    CHECK(sim::sent(99) == Slot);
    CHECK(send(Serial2, Next));
    CHECK(sim::sent(99) == Next);
    CHECK(sim::requestOf(2) == first);
    CHECK(sim::requestOf(5) == second);
    CHECK(first == 3);
    sim::begin(1);  // channel 6, and so the request of channel 7, which sends on Serial2
  }
}

TEST_CASE("a channel that SPI or Wire has is left to it; without a channel nothing is sent, and there is no room") {
  sim::reset();
  sim::begin(1);
  CHECK(stm32l0_dma_enable(sim::channelOf(7, 6), nullptr, nullptr));  // Wire's channel 7
  CHECK(send(Serial2, Slot));
  CHECK(sim::dma.channels[3].owner == STM32L0_DMA_CHANNEL_DMA1_CH4_USART2_TX);
  CHECK(sim::sent(99) == Slot);
  sim::reset();
  sim::begin(1);
  CHECK(stm32l0_dma_enable(sim::channelOf(7, 6), nullptr, nullptr));
  CHECK(stm32l0_dma_enable(sim::channelOf(4, 2), nullptr, nullptr));  // SPI's channel 4
  CHECK_FALSE(send(Serial2, Slot));
  CHECK(sbus::DmaSender::room(&Serial2) == 0);
  CHECK(sim::sent(99).empty());
}

TEST_CASE("what is left when the port is opened again is never sent, and it sends the next") {
  sim::reset();
  sim::begin(0);
  CHECK(send(Serial1, Slot));
  CHECK(sim::sent(1) == Characters{0x03});
  sim::begin(0);
  CHECK(sim::sent(99).empty());
  CHECK(sbus::DmaSender::room(&Serial1) == 36);
  CHECK(send(Serial1, Next));
  CHECK(sim::sent(99) == Next);
}

TEST_CASE("each object on the port waits at open() and close() until what any of them has given has gone out") {
  const auto opens = [](sbus::Port &port) { port.open(sbus::Baud, sbus::Inverted); };
  const auto closes = [](sbus::Port &port) { port.close(); };
  void (*const methods[])(sbus::Port &) = {opens, closes};
  for (const auto method : methods) {
    sim::reset();
    sbus::Port sender(Serial1), receiver(Serial1), other(Serial2);
    sim::begin(0);
    CHECK(sender.write(Slot.data(), Slot.size()));
    method(other);  // would wait forever
    CHECK(sim::gone.empty());
    sim::timePasses = true;
    method(receiver);
    CHECK(sim::gone == Slot);
    CHECK((USART1->ISR & USART_ISR_TC) != 0);
    CHECK(sender.write(Next.data(), Next.size()));
    method(sender);
    CHECK(sim::gone == Characters{0x03, 0xC0, 0x31, 0x83, 0x12, 0x34});
  }
}

TEST_CASE("a call is fresh while the receiver's ring stands at its half or its end; without a ring it never is") {
  sim::reset();
  sim::begin(0);
  sim::DmaChannel &receiver = sim::dma.channels[2];
  receiver.size = 32;
  for (uint16_t filled = 0; filled < 32; filled++) {
    receiver.left = static_cast<uint16_t>(32 - filled);
    CHECK(sbus::DmaSender::cameAtOnce(&Serial1) == (filled % 16 == 0));
  }
  CHECK_FALSE(sbus::DmaSender::cameAtOnce(&Serial3));
}

TEST_CASE("a port that is none of the board's is left to its own write()") {
  const Uart other;
  CHECK_FALSE(sbus::DmaSender::knows(&other));
  CHECK(sbus::DmaSender::knows(&Serial1));
  CHECK(sbus::DmaSender::room(&other) == 0);
}

// A sketch that only receives on an STM32L0 does not bring the sender and the board's other ports with it: this program
// has no port/DmaSender, and it links.
#include <Arduino.h>
#include <doctest/doctest.h>
#include <stm32l0_dma.h>

#include <DecodeSBus.h>

Uart Serial1;

TEST_CASE("without the sender a decoder opens and closes its port as often as it likes") {
#if !defined(SBUS_DMA_SENDER)
  FAIL("on this stand-in nothing sends by DMA");
#endif
  DecodeSBus dSBus(Serial1);
  for (int i = 0; i < 2; i++) {
    dSBus.begin();
    dSBus.begin();
    dSBus.end();
  }
  CHECK(dSBus.linkState() == sbus::LinkState::NeverSeen);
}

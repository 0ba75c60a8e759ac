#include "CallbackPort.h"

#if defined(SBUS_STM32L0)

namespace sbus {

namespace {

// An explicit instantiation may name a private member, and its friend then knows it.
template <stm32l0_uart_t *Uart::*Member>
struct StateOf {
  friend stm32l0_uart_t *stateOf(Uart &port) { return port.*Member; }
};
stm32l0_uart_t *stateOf(Uart &port);
template struct StateOf<&Uart::_uart>;

}  // namespace

stm32l0_uart_t *uartOf(Uart &port) { return stateOf(port); }

}  // namespace sbus

#endif

// Reads a word from an odd address. A Cortex-M0 faults there, so this program must not end by itself: if QEMU were
// lenient, the unit programs would prove nothing about alignment.
#include <stdint.h>
#include <stdio.h>

int main() {
  static const uint32_t words[2] = {};
  const char *volatile address = reinterpret_cast<const char *>(words) + 1;
  uint32_t word;
  __asm__ volatile("ldr %0, [%1]" : "=r"(word) : "r"(address));
  printf("read %08lx\n", static_cast<unsigned long>(word));
  return 0;
}

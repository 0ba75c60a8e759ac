// What the C++ library calls to throw. Ubuntu 24.04's libc++ for WebAssembly refers to both functions and no library
// there has them; weak, so that a library that has them prevails. Nothing here throws: a call ends the page's worker as
// a trap.

#include <cstddef>

extern "C" {

[[noreturn, gnu::weak]] void *__cxa_allocate_exception(std::size_t) { __builtin_trap(); }

[[noreturn, gnu::weak]] void __cxa_throw(void *, void *, void (*)(void *)) { __builtin_trap(); }

}  // extern "C"

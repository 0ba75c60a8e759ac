/// @file
/// A sketch's array of channels, whose size the compiler checks.
#pragma once

#include <stddef.h>
#include <stdint.h>

namespace sbus {

/// What a function takes that reads or writes `Count` channels: an array, which does not compile if it is too small, or
/// a pointer to as many values. `Value` is const uint16_t, or uint16_t if it writes.
template <typename Value, uint8_t Count>
class ChannelArray {
  template <typename>
  struct OfPointer {};
  template <typename Any>
  struct OfPointer<Any *> {
    using Type = Any *;
  };

 public:
  /// Takes an array.
  template <size_t Size>
  ChannelArray(Value (&array)[Size]) : _first(array) {
    static_assert(Size >= Count || Count != 16, "The array is too small: CH1..CH16 are uint16_t channels[16]");
    static_assert(Size >= Count || Count != 18,
                  "The array is too small: CH1..CH16, CH17 and CH18 are uint16_t channels[18]");
    static_assert(Size >= Count || Count != 24, "The array is too small: CH1..CH24 are uint16_t channels[24]");
  }

  /// Takes a pointer, or an array whose size another file knows: not nullptr, which does not compile.
  template <typename Pointer>
  ChannelArray(Pointer pointer, decltype(static_cast<Value *>(typename OfPointer<Pointer>::Type())) = nullptr)
      : _first(pointer) {}

  /// Returns the address of CH1; nullptr if the pointer was.
  operator Value *() const { return _first; }

 private:
  Value *_first;
};

}  // namespace sbus

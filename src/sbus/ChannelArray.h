/// @file
/// A sketch's array of channels; the compiler checks its size.
#pragma once

#include <stddef.h>
#include <stdint.h>

namespace sbus {

/// The parameter of a function that reads or writes `Count` channels: an array, which does not compile if it is too
/// small, or a pointer to as many values. `Value` is const uint16_t, or uint16_t if the function writes.
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

  /// Takes a pointer, or an array with a size that only another file knows. nullptr does not compile.
  template <typename Pointer>
  ChannelArray(Pointer pointer, decltype(static_cast<Value *>(typename OfPointer<Pointer>::Type())) = nullptr)
      : _first(pointer) {}

  /// Returns the address of CH1, or nullptr if the pointer was nullptr.
  operator Value *() const { return _first; }

 private:
  Value *_first;
};

}  // namespace sbus

// Callback: a function or an object's method, like the board's core (cores/arduino/Callback.h). And the processor's
// interrupt mask (CMSIS): here callbacks run only when time passes, so it has nothing to do.
#pragma once

#include <stdint.h>

class Callback {
 public:
  Callback() {}
  Callback(void (*function)()) : _function(function) {}
  template <typename T>
  Callback(void (T::*method)(), T *object)
      : _method(reinterpret_cast<Method>(method)), _object(object), _call(callMethod<T>) {}

  // Returns the object or the function that is called, for the report; null for an empty callback.
  const void *listener() const { return _object != nullptr ? _object : reinterpret_cast<const void *>(_function); }

  void call() const {
    if (_function != nullptr) {
      _function();
    } else if (_call != nullptr) {
      _call(*this);
    }
  }

 private:
  using Method = void (Callback::*)();
  template <typename T>
  static void callMethod(const Callback &callback) {
    (static_cast<T *>(callback._object)->*reinterpret_cast<void (T::*)()>(callback._method))();
  }

  void (*_function)() = nullptr;
  Method _method = nullptr;
  void *_object = nullptr;
  void (*_call)(const Callback &callback) = nullptr;
};

inline uint32_t __get_PRIMASK() { return 0; }
inline void __set_PRIMASK(uint32_t) {}
inline void __disable_irq() {}

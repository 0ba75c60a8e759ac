// The part of doctest that the unit programs use, without streams, exceptions and RTTI, for which 1.5 GB of C++ library
// would have to be installed. A failed REQUIRE ends the program.
#pragma once

#include <cstdio>
#include <string>
#include <type_traits>

namespace doctest {

using String = std::string;

template <typename T>
struct StringMaker {
  static String convert(const T &) { return "?"; }
};

template <typename T>
String toString(const T &value) {
  if constexpr (std::is_constructible_v<String, T>) {
    return String(value);
  } else if constexpr (std::is_arithmetic_v<T>) {
    return std::to_string(value);
  } else {
    return StringMaker<T>::convert(value);
  }
}

// As doctest has it.
struct Approx {
  double value;
  explicit Approx(double expected) : value(expected) {}
};
bool operator==(double value, const Approx &expected);

// A failed check shows this text besides its line, as long as this object lives.
class Context {
 public:
  Context();
  Context(const Context &) = delete;
  Context &operator=(const Context &) = delete;
  virtual String text() const = 0;
  const Context *outer() const { return _outer; }

 protected:
  ~Context();

 private:
  const Context *_outer;
};

template <typename Text>
class Info : public Context {
 public:
  explicit Info(Text text) : _text(text) {}
  String text() const override { return _text(); }

 private:
  Text _text;
};

template <typename... Values>
String join(const Values &...values) {
  return (toString(values) + ...);
}

class TestCase {
 public:
  TestCase(const char *name, void (*run)());

  // Runs them in the order of their file. Returns the status of the program.
  static int runAll();

 private:
  const char *_name;
  void (*_run)();
  TestCase *_next = nullptr;
};

// Counts a check. Returns `good`.
bool check(bool good, const char *file, int line, const char *text);
[[noreturn]] void giveUp();

}  // namespace doctest

#define DOCTEST_NAMED(name, line) DOCTEST_JOIN(name, line)
#define DOCTEST_JOIN(a, b) a##b
#define DOCTEST_TEST(function, instance, name)       \
  static void function();                            \
  static doctest::TestCase instance(name, function); \
  static void function()

#define TEST_CASE(name) DOCTEST_TEST(DOCTEST_NAMED(test, __LINE__), DOCTEST_NAMED(testCase, __LINE__), name)
#define CHECK(...) static_cast<void>(doctest::check(static_cast<bool>(__VA_ARGS__), __FILE__, __LINE__, #__VA_ARGS__))
#define CHECK_FALSE(...) \
  static_cast<void>(doctest::check(!static_cast<bool>(__VA_ARGS__), __FILE__, __LINE__, "not " #__VA_ARGS__))
#define REQUIRE(...) \
  (doctest::check(static_cast<bool>(__VA_ARGS__), __FILE__, __LINE__, #__VA_ARGS__) ? void() : doctest::giveUp())
#define REQUIRE_FALSE(...)                                                                           \
  (doctest::check(!static_cast<bool>(__VA_ARGS__), __FILE__, __LINE__, "not " #__VA_ARGS__) ? void() \
                                                                                            : doctest::giveUp())
#define FAIL(...) (doctest::check(false, __FILE__, __LINE__, doctest::join(__VA_ARGS__).c_str()), doctest::giveUp())
#define INFO(...) const doctest::Info DOCTEST_NAMED(info, __LINE__)([&] { return doctest::join(__VA_ARGS__); })
#define CAPTURE(value) INFO(#value " := ", value)

// S.Bus bytes from a pipe, or from standard input.
#pragma once

#include <string>

#include "line/Line.h"

namespace line {

// A byte that has come goes over the line at once, or straight after the one before.
class ByteStream : public Line {
 public:
  // `name`: a file, or - for standard input. `patient`: next() waits for bytes, whatever the time. Throws
  // std::runtime_error.
  ByteStream(const std::string &name, uint32_t characterUs, bool patient);
  ~ByteStream() override;
  ByteStream(const ByteStream &) = delete;
  ByteStream &operator=(const ByteStream &) = delete;

  bool next(uint64_t nowUs, Character &character) override;
  bool finished(uint64_t nowUs) const override;
  std::string failure() const override { return _failure; }

 private:
  static constexpr uint64_t TailUs = 300000;  // as RecordedLine's

  bool fill();

  std::string _name;
  int _file;
  uint32_t _characterUs;
  bool _patient;
  uint8_t _bytes[256];
  size_t _count = 0;
  size_t _at = 0;  // of the next in _bytes
  uint64_t _readUs = 0;
  uint64_t _lastEndUs = 0;
  bool _ended = false;
  std::string _failure;
};

}  // namespace line

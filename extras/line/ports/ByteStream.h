// S.Bus bytes from a pipe, or from standard input.
#pragma once

#include <deque>
#include <string>
#include <string_view>

#include "line/Line.h"
#include "line/ports/PipeAges.h"
#include "line/ports/PortReads.h"

namespace line {

// A pipe delivers a frame in pieces, like a port.
class ByteStream : public Line {
 public:
  enum class Pace {
    Live,      // bytes are played as they come
    LineRate,  // a file: bytes that come faster than on a line are held back
    Patient    // next() waits for bytes, whatever the time, and there is no silence between them
  };

  // Reads `file`, which the caller closes; `begin` has already been read from it. Throws std::runtime_error.
  ByteStream(const std::string &name, int file, std::string begin, uint32_t characterUs, Pace pace);
  ByteStream(const ByteStream &) = delete;
  ByteStream &operator=(const ByteStream &) = delete;

  bool next(uint64_t nowUs, Character &character) override;
  bool finished(uint64_t nowUs) const override;
  // Returns the time up to which all bytes are known. After its end the stream is silent.
  uint64_t knownUs(uint64_t nowUs) const override { return _ended && _waiting.empty() ? nowUs : _reads.knownUs(); }
  bool wait() override;
  bool isBroken() const override { return _pace == Pace::Live; }
  std::string failure() const override { return _failure; }

 private:
  static constexpr size_t ReadMax = 256;

  void fill(uint64_t nowUs);
  void take(std::string_view bytes, uint64_t nowUs);

  std::string _name;
  const int _file;
  std::string _begin;
  PortReads _reads;
  const uint32_t _characterUs;
  const Pace _pace;
  PipeAges _ages;
  std::deque<Character> _waiting;
  uint64_t _lastEndUs = 0;
  bool _ended = false;
  std::string _failure;
};

}  // namespace line

// The input of the sketch's Serial: standard input.
#pragma once

#include <cstddef>
#include <cstdint>

namespace host {

// It reads bytes when the sketch asks for some, as many as the board's USB buffer holds. Bytes that the sketch does not
// need are left unread.
class SketchInput {
 public:
  static constexpr size_t BufferSize = 256;

  // If `patient`, it waits until a pipe or a file has filled the buffer or ended, so that every run reads the same
  // bytes. It gives up on a pipe that has been silent for a second.
  void setPatient(bool patient) { _patient = patient; }

  // Before begin() there is nothing to read, as on the board.
  void begin() { _begun = true; }

  // These are the sketch's calls. peek() and read() return -1 if there are no bytes.
  int available(uint64_t nowUs);
  int peek(uint64_t nowUs);
  int read(uint64_t nowUs);
  int read(uint64_t nowUs, uint8_t *buffer, size_t size);  // returns the number of bytes read, up to `size`

 private:
  void fetch(uint64_t nowUs);
  void fetchFromStandardInput();
  size_t room() const { return BufferSize - _count; }
  void take(const uint8_t *bytes, size_t size);

  bool _begun = false;
  bool _patient = false;
  bool _ended = false;  // standard input has ended
  uint64_t _nextPollUs = 0;
  uint8_t _buffer[BufferSize] = {};
  size_t _first = 0;
  size_t _count = 0;
};

}  // namespace host

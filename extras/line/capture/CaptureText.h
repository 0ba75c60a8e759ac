// Takes a capture's text in pieces of any size, from a file or from a page.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "line/capture/WireDecoder.h"

namespace line {

struct CaptureEnd {
  std::string format;     // "PulseView CSV"
  double periodNs = 0;    // between two samples; 0 if unknown
  std::string error;      // with its place in the file; the part before it was decoded. Empty without an error
  std::string rejection;  // why it is not a capture, and nothing was decoded; empty if it is one
  bool isCut = false;     // the error is that the last line is not whole
};

class CaptureText {
 public:
  // `name` is the file's name in messages.
  CaptureText(std::string name, const Overrides &overrides, WireDecoder &decoder);

  // Takes the next bytes. Returns false after an error, and ignores all further bytes.
  bool put(std::string_view bytes);

  // Takes the end. `failure` says why the file was not read to its end; otherwise it is empty.
  CaptureEnd finish(const std::string &failure);

 private:
  void take(bool more);

  const std::string _name;
  const Overrides _overrides;
  WireDecoder &_decoder;
  std::unique_ptr<CaptureReader> _reader;
  std::vector<char> _block;
  size_t _filled = 0;
  bool _cutOff = false;    // the wrong line has no end
  std::string _error;      // about a line
  std::string _rejection;  // about the file
};

}  // namespace line

// Takes a capture's text in pieces of any size: from a file, or from a page.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "line/capture/WireDecoder.h"

namespace line {

struct CaptureEnd {
  std::string format;     // "PulseView CSV"
  double periodNs = 0;    // between two samples; 0 if it is not known
  std::string error;      // with its place in the file; what came before was decoded. Empty if nothing is wrong
  std::string rejection;  // why it is no capture, so that nothing was decoded; empty if it is one
};

class CaptureText {
 public:
  // `name` is the file's, for messages.
  CaptureText(std::string name, const Overrules &overrules, WireDecoder &decoder);

  // Takes the next bytes. Returns false once something is wrong, and then ignores all further bytes.
  bool put(std::string_view bytes);

  // Takes the end. `failure` says why the file was not read to its end; it is empty if it was.
  CaptureEnd finish(const std::string &failure);

 private:
  void take(bool more);

  const std::string _name;
  const Overrules _overrules;
  WireDecoder &_decoder;
  std::unique_ptr<CaptureReader> _reader;
  std::vector<char> _block;
  size_t _filled = 0;
  bool _cutOff = false;    // the wrong line has no end
  std::string _error;      // in a line
  std::string _rejection;  // of the file
};

}  // namespace line

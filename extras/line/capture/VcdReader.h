// Reads a value change dump, which nearly every logic analyser and simulator can write (IEEE 1364, chapter 18). Its
// signals are scalar variables and bits of vectors.
#pragma once

#include <array>
#include <unordered_map>

#include "line/capture/Capture.h"

namespace line {

class VcdReader : public CaptureReader {
 public:
  explicit VcdReader(LevelSink &sink) : CaptureReader(sink) { _byCharacter.fill(None); }

  std::string put(std::string_view lines) override;
  std::string finish() override;
  std::string format() const override { return "VCD"; }

 private:
  static constexpr size_t None = SIZE_MAX;

  std::string headerWord(std::string_view word);
  std::string endSection();
  std::string defineVariable();
  void setVector(size_t lowest);
  std::string bodyWord(std::string_view word);
  std::string setTime(std::string_view digits);
  // Returns the signal of a code; for a vector, its lowest bit's, which the higher bits' follow.
  size_t signalOf(std::string_view code) const;

  bool _inBody = false;
  bool _hasReals = false;
  bool _passing = false;      // ignores words up to $end; in the body, a comment's
  bool _codeFollows = false;  // the code of a vector, a real or a string is next
  std::string _bits;          // that vector's value
  std::string _section;       // "$var": collects the section's words up to $end
  std::vector<std::string> _words;
  std::vector<std::string> _scopes;
  std::vector<std::string> _names;
  std::vector<size_t> _widths;           // by signal, if it is a variable's lowest bit: the variable's
  std::array<size_t, 128> _byCharacter;  // signals with a code of one character
  std::unordered_map<std::string, size_t> _byCode;
  double _unitNs = 0;  // of time; 0 before it is told
  int64_t _ns = 0;
};

}  // namespace line

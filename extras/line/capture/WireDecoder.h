// Decodes the characters of a capture: those of the signal that carries S.Bus, at any baud rate and polarity.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "line/capture/Capture.h"
#include "line/capture/Overrules.h"
#include "line/capture/WireFinder.h"
#include "line/uart/Levels.h"

namespace line {

// It keeps the newest edges of each signal until one has frames; then it decodes the signal with the most frames, and
// forgets the others. If the capture ends before that, and has only one signal to look at, it decodes that signal's
// characters.
class WireDecoder : public LevelSink {
 public:
  // `found` is called once, before the first character; `level` for each level of the chosen signal.
  WireDecoder(Overrules overrules, std::function<void()> found, std::function<void(const WireCharacter &)> character,
              std::function<void(int64_t ns, bool high)> level = nullptr)
      : _overrules(std::move(overrules)),
        _onFound(std::move(found)),
        _onCharacter(std::move(character)),
        _onLevel(std::move(level)) {}

  void ofCharacters() override { _isMeasured = false; }
  void signals(const std::vector<std::string> &names) override;
  void level(size_t signal, int64_t ns, bool high) override {
    _lastNs = ns;
    if (!_decoder) {
      collect(signal, ns, high);
    } else if (signal == _chosen) {
      decode(ns, high);
    }
  }

  // Takes the end of the capture at `endNs`. A character that is not complete by then is left out. But if the capture
  // ends with an edge, and is not `cutOff`, the wire kept its level: then the last character is taken if it is good.
  void finish(int64_t endNs, bool cutOff);

  // Returns the time up to which the wire is known, after finish().
  int64_t endNs() const { return _endNs; }

  bool found() const { return _decoder.has_value(); }
  const FoundWire &wire() const { return _wire; }
  const std::string &signal() const { return _names[_chosen]; }

  // Returns false if an analyser has decoded the characters: then only wire().frames is true.
  bool isMeasured() const { return _isMeasured; }

  // Returns the other signals that carry S.Bus.
  const std::vector<std::string> &others() const { return _others; }

  // Returns why none was found, after finish(). `periodNs`: between two samples, 0 if it is not known.
  std::string failure(double periodNs) const;

 private:
  static constexpr size_t Shown = 8;         // signals, in a message
  static constexpr size_t SampleMax = 2048;  // edges: thirteen frames

  void collect(size_t signal, int64_t ns, bool high);
  bool isWanted(size_t signal) const { return _overrules.signal.empty() || _names[signal] == _overrules.signal; }
  void choose();
  void chooseOnly();
  void begin();
  std::string someNames() const;
  void decode(int64_t ns, bool high) {
    if (_onLevel) {
      _onLevel(ns, high);
    }
    if (_decoder->level(ns, high, _character)) {
      _onCharacter(_character);
    }
  }

  const Overrules _overrules;
  const std::function<void()> _onFound;
  const std::function<void(const WireCharacter &)> _onCharacter;
  const std::function<void(int64_t, bool)> _onLevel;
  std::vector<std::string> _names;           // of the signals
  std::vector<std::vector<Level>> _samples;  // of each signal
  std::vector<std::string> _others;
  bool _isMeasured = true;
  size_t _chosen = 0;
  FoundWire _wire;
  std::optional<CharacterDecoder> _decoder;  // none before a signal is chosen
  WireCharacter _character;
  int64_t _lastNs = INT64_MIN;  // of the newest level
  int64_t _endNs = 0;
};

}  // namespace line

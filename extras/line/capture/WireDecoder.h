// Decodes the characters of the signal that carries S.Bus in a capture, with any baud rate and polarity.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "line/capture/Capture.h"
#include "line/capture/EdgeStore.h"
#include "line/capture/WireFinder.h"
#include "line/uart/Levels.h"

namespace line {

// It keeps the edges of each signal until one has frames; then it decodes the signal with the most frames from its
// beginning, and drops the others. If the capture ends before that and has only one candidate, it decodes that signal's
// characters.
class WireDecoder : public LevelSink {
 public:
  // `found` is called once, before the first character; `level` for each level of the chosen signal. It keeps at most
  // `keptMax` bytes.
  WireDecoder(Overrides overrides, std::function<void()> found, std::function<void(const WireCharacter &)> character,
              std::function<void(int64_t ns, bool high)> level = nullptr, size_t keptMax = size_t{64} << 20)
      : _keptMax(keptMax),
        _overrides(std::move(overrides)),
        _onFound(std::move(found)),
        _onCharacter(std::move(character)),
        _onLevel(std::move(level)) {}

  void fromCharacters() override { _isMeasured = false; }
  void signals(const std::vector<std::string> &names) override;
  void level(size_t signal, int64_t ns, bool high) override {
    _beginNs = std::min(_beginNs, ns);
    _lastNs = ns;
    if (!_decoder) {
      collect(signal, ns, high);
    } else if (signal == _chosen) {
      decode(ns, high);
    }
  }

  // Takes the end of the capture at `endNs`. A character incomplete by then is left out, unless the capture ends with
  // an edge and is not `cutOff`: then the wire kept its level, and the last character is taken if it is good.
  void finish(int64_t endNs, bool cutOff);

  // Return when the capture begins and, after finish(), when it ends.
  int64_t beginNs() const { return _beginNs; }
  int64_t captureEndNs() const { return _captureEndNs; }
  // Returns, after finish(), the time up to which the wire is known.
  int64_t endNs() const { return _endNs; }

  bool found() const { return _decoder.has_value(); }
  const FoundWire &wire() const { return _wire; }
  const std::string &signal() const { return _names[_chosen]; }

  // Returns false if an analyser decoded the characters: then only wire().frames is valid.
  bool isMeasured() const { return _isMeasured; }

  // Returns the other signals that carry S.Bus.
  const std::vector<std::string> &others() const { return _others; }

  // Returns from when on the signal is decoded, if it had more edges before its first frame than are kept; otherwise
  // "".
  std::string note() const;

  // Returns, after finish(), why no signal was found. `periodNs`: the time between two samples; 0 if unknown.
  std::string failure(double periodNs) const;

 private:
  static constexpr size_t Shown = 8;         // signals named in a message
  static constexpr size_t SampleMax = 2048;  // edges: thirteen frames

  // A signal before one is chosen.
  struct Collected {
    explicit Collected(size_t bytesMax) : kept(bytesMax) {}

    std::vector<Level> sample;  // the newest levels, among which frames are looked for
    EdgeStore kept;             // all levels from `fromNs` on
    int64_t fromNs = INT64_MIN;
  };

  void collect(size_t signal, int64_t ns, bool high);
  bool isWanted(size_t signal) const { return _overrides.signal.empty() || _names[signal] == _overrides.signal; }
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

  const size_t _keptMax;
  const Overrides _overrides;
  const std::function<void()> _onFound;
  const std::function<void(const WireCharacter &)> _onCharacter;
  const std::function<void(int64_t, bool)> _onLevel;
  std::vector<std::string> _names;    // the signals'
  std::vector<Collected> _collected;  // by signal
  int64_t _decodedNs = INT64_MIN;     // edges before this time were dropped
  std::vector<std::string> _others;
  bool _isMeasured = true;
  size_t _chosen = 0;
  FoundWire _wire;
  std::optional<CharacterDecoder> _decoder;  // once a signal has been chosen
  WireCharacter _character;
  int64_t _beginNs = INT64_MAX;
  int64_t _lastNs = INT64_MIN;  // the newest level's time
  int64_t _captureEndNs = 0;
  int64_t _endNs = 0;
};

}  // namespace line

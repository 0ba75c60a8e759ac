// A recording of a line, as a text file:
//
//   # a comment
//   120 0F E5 03! 1F       time in us at which the first character was complete, then back-to-back characters; ! marks
//                          one with a wrong parity or stop bit
//   16120~18000 0F E5      from a port that delivers bytes late: each was complete up to 18000 us earlier, and gaps may
//                          lie between them
//
// The times of a capture's recording begin below 0 if the capture begins before its trigger.
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "line/Line.h"
#include "line/LineSettings.h"

namespace line {

// Characters in order, 8 bytes each, plus 16 for each read of a late port: an hour of S.Bus has nine million.
class Characters {
 public:
  class Iterator {
   public:
    Iterator(const Characters &characters, size_t index) : _characters(characters), _index(index) {}
    Character operator*() const { return _characters[_index]; }
    Iterator &operator++() {
      _index++;
      return *this;
    }
    bool operator!=(const Iterator &other) const { return _index != other._index; }

   private:
    const Characters &_characters;
    size_t _index;
  };

  void push_back(const Character &character) {
    if (character.lateUs != (_late.empty() ? 0 : _late.back().us)) {
      _late.push_back({size(), character.lateUs});
    }
    _packed.push_back(character.endUs << 9 | (character.bad ? 0x100u : 0u) | character.value);
  }

  Character operator[](size_t index) const {
    const uint64_t packed = _packed[index];
    return {packed >> 9, static_cast<uint8_t>(packed), (packed & 0x100) != 0, lateUs(index)};
  }
  Character back() const { return (*this)[size() - 1]; }
  size_t size() const { return _packed.size(); }
  bool empty() const { return _packed.empty(); }
  Iterator begin() const { return {*this, 0}; }
  Iterator end() const { return {*this, size()}; }

  // Returns true if a port delivered some of them late.
  bool isLate() const { return !_late.empty(); }

  // Returns Line::knownUs() for a line that has delivered the first `count` of them.
  uint64_t knownUs(size_t count, uint64_t nowUs) const {
    const Character next = count < size() ? (*this)[count] : Character{nowUs + CharacterUs};
    return std::min(nowUs, next.endUs - std::min<uint64_t>(next.endUs, CharacterUs + next.lateUs));
  }

 private:
  struct Late {
    size_t from;  // index
    uint32_t us;
  };

  uint32_t lateUs(size_t index) const {
    const auto after =
        std::upper_bound(_late.begin(), _late.end(), index, [](size_t i, const Late &late) { return i < late.from; });
    return after == _late.begin() ? 0 : std::prev(after)->us;
  }

  std::deque<uint64_t> _packed;  // a vector would need three times the memory while it grows
  std::deque<Late> _late;        // an entry for each change
};

struct Recording {
  Characters characters;
  int64_t zeroUs = 0;    // the file's time from which the characters' times count; not above 0
  uint64_t beginUs = 0;  // a capture begins and ends at these times; 0 if it is none
  uint64_t endUs = 0;
  std::string error;       // what is wrong and what is expected; otherwise empty
  unsigned errorLine = 0;  // its line, counted from 1; 0 for the recording as a whole
};

constexpr size_t RecordingLineMax = 4096;                                     // characters of text
constexpr uint64_t RecordingTimeMaxUs = uint64_t{366} * 24 * 3600 * 1000000;  // a year: later times are a mistake

constexpr size_t RecordingBeginning = 4096;  // bytes of a file that show its kind

// Returns the settings of the recorded line from RecordingWriter::opened()'s comment before the first character: Fast
// S.Bus, a sender with one stop bit, 8E1, or a sketch's Serial, 8N1; without the comment S.Bus.
LineSettings settingsIn(std::string_view beginning);

// Returns time 0 of the recorded line in us since 1970, from RecordingWriter::began()'s comment.
std::optional<int64_t> startIn(std::string_view beginning);

// Returns true for a line of column names that begins with a time, as sbus csv and the scope write it.
bool hasTimeColumn(std::string_view text);

// Returns true if the text is not a recording, but a sketch's rows.
bool isCsvText(std::string_view beginning);

}  // namespace line

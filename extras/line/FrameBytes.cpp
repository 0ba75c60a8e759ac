#include "line/FrameBytes.h"

#include <algorithm>
#include <array>

#include "sbus/Frame.h"

namespace line {

std::vector<uint8_t> frameBytes(Stretch::Kind kind, const Values &values, uint8_t end) {
  std::vector<uint8_t> frame(kind == Stretch::Kind::Frame24 ? sbus::FrameSize24 : sbus::FrameSize);
  if (kind == Stretch::Kind::Frame24) {
    sbus::pack24(frame.data(), values.raw.data(), values.failsafe, values.lostFrame);
    frame.back() = end;
    return frame;
  }
  const bool isExtra = kind == Stretch::Kind::Extra;
  std::array<uint16_t, sbus::ChannelCount> channels{};
  std::copy_n(values.raw.begin() + (isExtra ? sbus::ProportionalCount : 0), sbus::ProportionalCount, channels.begin());
  std::copy(values.switches.begin(), values.switches.end(), channels.begin() + sbus::ProportionalCount);
  sbus::pack(frame.data(), channels.data(), values.failsafe, values.lostFrame);
  frame.front() = isExtra ? sbus::ExtraHeader : frame.front();
  frame.back() = end;
  return frame;
}

uint64_t appendBackToBack(const std::vector<Character> &came, uint64_t endUs, uint64_t lastUs, uint32_t characterUs,
                          std::deque<Character> &characters) {
  uint64_t us = std::max(lastUs, endUs - std::min(endUs, uint64_t{came.size()} * characterUs));
  for (Character character : came) {
    us += characterUs;
    character.endUs = us;
    characters.push_back(character);
  }
  return us;
}

uint64_t appendLate(const std::vector<Character> &came, uint64_t endUs, uint64_t lastUs, uint32_t characterUs,
                    uint32_t lateUs, std::deque<Character> &characters) {
  const uint64_t roomUs = (endUs - std::min(endUs, lastUs)) / came.size();
  const size_t from = characters.size();
  const auto eachUs = static_cast<uint32_t>(std::clamp<uint64_t>(lateUs > 0 ? roomUs : characterUs, 1, characterUs));
  lastUs = appendBackToBack(came, endUs, lastUs, eachUs, characters);
  for (size_t i = from; i < characters.size(); i++) {
    characters[i].lateUs = lateUs;
  }
  return lastUs;
}

std::vector<Character> charactersOf(const std::vector<uint8_t> &bytes) {
  std::vector<Character> characters(bytes.size());
  for (size_t i = 0; i < bytes.size(); i++) {
    characters[i].value = bytes[i];
  }
  return characters;
}

}  // namespace line

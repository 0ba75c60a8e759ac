// The recording reader on any text gives characters in order and not closer than a wire allows, or one clear error.
#include <cstdio>
#include <string>

#include "fuzz/Require.h"
#include "line/recording/RecordingReader.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  const std::string text(data, data + size);
  const line::Recording recording = line::parseRecording(text);
  require(recording.error.empty() || recording.error.size() < 300, "errors are short");
  for (const char c : recording.error) {
    require(c >= ' ' && c <= '~', "errors can be shown on a terminal");
  }
  require(!recording.error.empty() || !recording.characters.empty(), "without an error there are characters");
  require(recording.error.empty() || recording.errorLine <= 1 + size, "the line of an error is in the text");
  require(recording.characters.size() <= size / 2 + 1, "no more characters than words");
  uint64_t earliest = 0;
  for (const line::Character character : recording.characters) {
    require(character.endUs >= earliest, "characters do not overlap");
    require(character.endUs <= line::RecordingTimeMaxUs + line::RecordingLineMax * line::CharacterUs,
            "none is too late");
    earliest = character.endUs + line::CharacterUs;
  }
  if (!recording.error.empty()) {
    return 0;
  }
  // A recording that is written and read again has the same characters.
  std::string written;
  for (const line::Character character : recording.characters) {
    char line[40];
    std::snprintf(line, sizeof(line), "%llu %02X%s\n", static_cast<unsigned long long>(character.endUs),
                  character.value, character.bad ? "!" : "");
    written += line;
  }
  if (recording.characters.back().endUs <= line::RecordingTimeMaxUs) {
    const line::Recording again = line::parseRecording(written);
    require(again.error.empty() && again.characters.size() == recording.characters.size(), "it can be written down");
    for (size_t i = 0; i < again.characters.size(); i++) {
      require(again.characters[i].endUs == recording.characters[i].endUs, "times are kept");
      require(again.characters[i].value == recording.characters[i].value, "bytes are kept");
      require(again.characters[i].bad == recording.characters[i].bad, "character errors are kept");
    }
  }
  return 0;
}

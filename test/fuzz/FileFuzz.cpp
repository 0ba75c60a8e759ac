// The reader of files on any bytes says what they are, and gives characters in order, or one clear error.
#include <cstdio>
#include <deque>
#include <string>

#include "fuzz/Require.h"
#include "line/file/FileHead.h"
#include "line/recording/RecordingReader.h"

namespace {

// A recording that is written and read again has the same characters.
void requireRereadable(const std::deque<line::Character> &characters, uint32_t characterUs) {
  std::string written;
  for (const line::Character &character : characters) {
    char line[40];
    std::snprintf(line, sizeof line, "%llu %02X%s\n", static_cast<unsigned long long>(character.endUs), character.value,
                  character.bad ? "!" : "");
    written += line;
  }
  const line::Recording again = line::parseRecording(written, characterUs);
  require(again.error.empty() && again.characters.size() == characters.size(), "it can be written down");
  for (size_t i = 0; i < characters.size(); i++) {
    const line::Character &one = characters[i], other = again.characters[i];
    require(other.endUs == one.endUs && other.value == one.value && other.bad == one.bad,
            "times, bytes and errors are kept");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  const std::string bytes(data, data + size);
  const line::FileHead head = line::readFileHead(bytes, "file");
  require((head.kind == line::FileKind::Wrong) == !head.error.empty(), "a wrong file has an error, and only that");
  require(head.zeroUs <= 0, "no file begins after its time 0");
  const std::unique_ptr<line::LineReader> reader = line::makeReader(head, true);
  require((reader == nullptr) == (head.kind == line::FileKind::Wrong || head.kind == line::FileKind::Capture),
          "texts and bytes have a reader");
  if (!reader) {
    return 0;
  }
  std::deque<line::Character> characters;
  std::string error;
  for (std::string_view rest = reader->takesBytes() ? bytes : head.begin; !rest.empty() && error.empty();) {
    const size_t end = reader->takesBytes() ? std::min<size_t>(rest.size(), 100) : rest.find('\n');
    error = reader->line(rest.substr(0, end), characters);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + (reader->takesBytes() ? 0 : 1));
  }
  error = error.empty() ? reader->finish(characters) : error;
  require(error.size() < 400, "errors are short");
  for (const char c : error) {
    require(c >= ' ' && c <= '~', "errors can be shown on a terminal");
  }
  require(!error.empty() || !characters.empty(), "without an error there are characters");
  require(reader->zeroUs() <= 0, "times begin at 0 or before");
  uint64_t lastUs = 0;
  for (const line::Character &character : characters) {
    require(character.endUs >= lastUs, "characters are in order");
    lastUs = character.endUs;
  }
  if (head.kind == line::FileKind::Recording && error.empty() && lastUs <= line::RecordingTimeMaxUs) {
    require(characters.size() <= size / 2 + 1, "no more characters than words");
    requireRereadable(characters, head.settings.characterUs());
  }
  return 0;
}

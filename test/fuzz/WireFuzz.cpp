// The readers of captures on any text give characters in order, or one clear error; the size of blocks makes no
// difference.
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "fuzz/Require.h"
#include "line/capture/CsvReader.h"
#include "line/capture/SessionReader.h"
#include "line/capture/WireDecoder.h"
#include "support/WireText.h"

namespace {

struct Result {
  std::vector<line::WireCharacter> characters;
  std::string error;
  uint64_t lines = 0;
  bool analogue = false;
};

void requireText(const std::string &text) {
  require(text.size() < 4000, "messages are short");
  for (const char c : text) {
    require(c >= ' ' && c <= '~', "messages can be shown on a terminal");
  }
}

// A session of sigrok, unpacked: its metadata begin with [ and end with a 0; samples follow.
Result decodeSession(const std::string &text, size_t piece) {
  Result result;
  line::WireDecoder decoder(
      {}, [] {}, [&result](const line::WireCharacter &character) { result.characters.push_back(character); });
  line::SessionReader reader(decoder, 0);
  const size_t end = std::min(text.find('\0'), text.size());
  result.error = reader.metadata(text.substr(0, end));
  const bool begun = result.error.empty();
  for (size_t from = end + 1; from < text.size() && result.error.empty(); from += piece) {
    result.error = reader.put(std::string_view(text).substr(from, piece));
  }
  if (begun) {
    decoder.finish(reader.endNs(), !result.error.empty());
    requireText(decoder.found() ? "" : decoder.failure(reader.periodNs()));
  }
  return result;
}

Result decode(const std::string &text, bool byLines) {
  if (text.substr(0, 1) == "[") {
    return decodeSession(text, byLines ? 1 : text.size());
  }
  Result result;
  line::WireDecoder decoder(
      {}, [] {}, [&result](const line::WireCharacter &character) { result.characters.push_back(character); });
  line::OpenedCapture opened = line::openCapture(std::string_view(text).substr(0, line::CaptureHeadMax), decoder);
  result.error = opened.error;
  require(opened.error.empty() == (opened.reader != nullptr), "a reader, or an error");
  if (!opened.reader) {
    return result;
  }
  result.analogue = opened.reader->needsFullBlocks();
  for (size_t from = 0; from < text.size() && result.error.empty();) {
    const size_t end = byLines ? std::min(text.find('\n', from), text.size() - 1) + 1 : text.size();
    result.error = opened.reader->put(std::string_view(text).substr(from, end - from));
    from = end;
  }
  result.lines = opened.reader->lines();
  result.error = result.error.empty() ? opened.reader->finish() : result.error;
  decoder.finish(opened.reader->endNs(), !result.error.empty());
  if (!decoder.found()) {
    require(result.characters.empty(), "no characters of a wire that was not found");
    requireText(decoder.failure(opened.reader->periodNs()));
  }
  return result;
}

}  // namespace

// Writes captures of some characters to the folder SEEDS, one in each format and with one or two signals. libFuzzer
// calls this before it reads its corpus.
extern "C" int LLVMFuzzerInitialize(int *argc, char ***argv);
extern "C" int LLVMFuzzerInitialize(int *, char ***) {
  const char *const folder = std::getenv("SEEDS");
  if (folder == nullptr) {
    return 0;
  }
  for (const bool second : {false, true}) {
    for (const TestFormat format : TestFormats) {
      TestWire wire;
      wire.bitNs = 5000;
      wire.ns = 10000;
      wire.bytes(std::vector<uint8_t>{0x0F, 0xE5, 0x03, 0x1F, 0xF8, 0xC0, 0x07, 0x3E});
      wire.gap(100000);
      const int number = static_cast<int>(format) * 2 + second;
      std::ofstream(folder + ("/seed" + std::to_string(number))) << textOf(wire, format, second);
    }
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  const std::string text(data, data + size);
  const Result whole = decode(text, false);
  requireText(whole.error);
  require(whole.lines <= 1 + size, "the line of an error is in the text");
  require(whole.characters.size() <= size, "no more characters than edges");
  for (size_t i = 1; i < whole.characters.size(); i++) {
    // Ten and a half bits, of 5 us at least, less 3 %.
    require(whole.characters[i].startNs >= whole.characters[i - 1].startNs + 50000, "characters do not overlap");
  }
  const Result pieces = decode(text, true);
  if (!whole.analogue) {  // a threshold is found block by block
    require(pieces.error == whole.error && pieces.lines == whole.lines, "errors do not depend on the blocks");
    require(pieces.characters.size() == whole.characters.size(), "characters do not depend on the blocks");
  }
  return 0;
}

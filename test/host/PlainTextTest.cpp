// Texts in the encodings and with the line ends of other programs.
#include "line/recording/PlainText.h"

#include <doctest/doctest.h>

#include <string>

namespace {

std::string plain(const std::string &bytes, size_t piece) {
  line::PlainText text;
  std::string all;
  for (size_t at = 0; at < bytes.size(); at += piece) {
    all += text.put(std::string_view(bytes).substr(at, piece));
  }
  all += text.finish();
  return all;
}

}  // namespace

TEST_CASE("a text in any encoding, with any line ends, in pieces of any size, is UTF-8 with LF") {
  using namespace std::string_literals;
  const struct {
    const char *what;
    std::string bytes, text;
  } rows[] = {
      {"nothing", "", ""},
      {"a byte", "1", "1"},
      {"LF", "1\n2\n", "1\n2\n"},
      {"CR and LF stay", "1\r\n2\r\n", "1\r\n2\r\n"},
      {"CR", "1\r2\r", "1\n2\n"},
      {"only CR", "\r", "\n"},
      {"CR in front", "\r1\r", "\n1\n"},
      {"a CR after lines with LF stays", "1\n2\r3\n", "1\n2\r3\n"},
      {"a mark of UTF-8", "\xEF\xBB\xBF" "1\n", "1\n"},
      {"a mark alone", "\xEF\xBB\xBF", ""},
      {"half a mark", "\xEF\xBB", "\xEF\xBB"},
      {"Latin-1", "\xB5s\n", "\xB5s\n"},
      {"UTF-16, little endian", "\xFF\xFE" "1\0\r\0\n\0\xB5\0"s, "1\r\n\xC2\xB5"},
      {"UTF-16, big endian, CR", "\xFE\xFF\0" "1\0\r\0" "2\0\r"s, "1\n2\n"},
      {"infinity", "\xFF\xFE\x1E\x22"s, "\xE2\x88\x9E"},
      {"a character of two units", "\xFF\xFE\x3D\xD8\x00\xDE"s, "\xF0\x9F\x98\x80"},
      {"its halves alone", "\xFF\xFE\x3D\xD8" "1\0\x00\xDE"s, "\xEF\xBF\xBD" "1" "\xEF\xBF\xBD"},
      {"half a unit", "\xFF\xFE" "1\0" "2"s, "1"},
  };
  for (const auto &row : rows) {
    for (const size_t piece : {1u, 2u, 3u, 5u, 100u}) {
      INFO(row.what, ", pieces of ", piece);
      CHECK(plain(row.bytes, piece) == row.text);
    }
  }
}

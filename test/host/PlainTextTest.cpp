// Texts in the encodings of other programs.
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

TEST_CASE("a text in UTF-8 or UTF-16, in pieces of any size, loses its mark, and keeps its line ends") {
  using namespace std::string_literals;
  const struct {
    const char *what;
    std::string bytes, text;
  } rows[] = {
      {"nothing", "", ""},
      {"a byte", "1", "1"},
      {"LF", "1\n2\n", "1\n2\n"},
      {"CR and LF stay", "1\r\n2\r\n", "1\r\n2\r\n"},
      {"a mark of UTF-8",
       "\xEF\xBB\xBF"
       "1\n",
       "1\n"},
      {"a mark alone", "\xEF\xBB\xBF", ""},
      {"half a mark", "\xEF\xBB", "\xEF\xBB"},
      {"Latin-1", "\xB5s\n", "\xB5s\n"},
      {"UTF-16",
       "\xFF\xFE"
       "1\0\r\0\n\0\xB5\0"s,
       "1\r\n\xB5"},
      {"infinity", "\xFF\xFE\x1E\x22"s, "\x9E"},
      {"half a unit",
       "\xFF\xFE"
       "1\0"
       "2"s,
       "1"},
  };
  for (const auto &row : rows) {
    for (const size_t piece : {1u, 2u, 3u, 5u, 100u}) {
      INFO(row.what, ", pieces of ", piece);
      CHECK(plain(row.bytes, piece) == row.text);
    }
  }
}

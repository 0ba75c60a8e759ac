// Splits texts that arrive in pieces into lines.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "line/file/LineSplitter.h"

namespace {

struct Lines {
  std::vector<std::string> lines;
  std::vector<std::string> wrong;  // with each
  bool isCut = false;              // the last one
};

Lines split(const std::string &text, size_t piece) {
  line::LineSplitter splitter;
  Lines all;
  const auto take = [&] {
    for (std::string line; splitter.take(line);) {
      all.lines.push_back(line);
      all.wrong.push_back(splitter.wrong());
      all.isCut = splitter.isCut();
      CHECK(splitter.number() == all.lines.size());
    }
  };
  for (size_t at = 0; at < text.size(); at += piece) {
    splitter.put(std::string_view(text).substr(at, piece));
    take();
  }
  splitter.put({});
  take();
  return all;
}

}  // namespace

TEST_CASE("lines are the same whatever the pieces, and only a last one without LF is cut") {
  for (const size_t piece : {size_t{1}, size_t{2}, size_t{3}, size_t{100}}) {
    CAPTURE(piece);
    const Lines whole = split("a\n\nbc\n", piece), cut = split("\na\nbc", piece);
    CHECK(whole.lines == std::vector<std::string>{"a", "", "bc"});
    CHECK_FALSE(whole.isCut);
    CHECK(cut.lines == std::vector<std::string>{"", "a", "bc"});
    CHECK(cut.isCut);
    CHECK(split("", piece).lines.empty());
  }
}

TEST_CASE("two pieces may come before a line is taken") {
  line::LineSplitter splitter;
  std::string line;
  splitter.put("a\nb\nc");
  CHECK(splitter.take(line));
  splitter.put("d\n");
  REQUIRE(splitter.take(line));
  CHECK(line == "b");
  REQUIRE(splitter.take(line));
  CHECK(line == "cd");
  CHECK_FALSE(splitter.take(line));
}

TEST_CASE("a line may have 16777216 characters; of a longer one a bounded part is handed over, and is wrong") {
  constexpr size_t Piece = 65536;
  const Lines longest = split("good\n" + std::string(line::TextLineMax, '7') + "\n", Piece);
  CHECK(longest.lines.size() == 2);
  CHECK(longest.wrong == std::vector<std::string>{"", ""});
  for (const size_t size : {line::TextLineMax + 1, 3 * line::TextLineMax}) {
    CAPTURE(size);
    const Lines all = split("good\n" + std::string(size, '7'), Piece);
    CHECK(all.lines[0] == "good");
    CHECK(all.wrong[0].empty());
    CHECK(all.lines[1].size() <= line::TextLineMax + Piece);
    CHECK(all.wrong[1] == "the line is longer than 16777216 characters: line ends are expected");
  }
}

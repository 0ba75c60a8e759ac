// Reads the text of a recording, or of rows.
#include <doctest/doctest.h>

#include "line/recording/CsvRows.h"
#include "line/recording/RecordingReader.h"
#include "line/recording/RecordingWriter.h"

using line::Recording;

namespace {

const std::string Mark = "\xEF\xBB\xBF";

// Returns when each row was complete.
std::vector<uint64_t> rowEnds(const std::vector<std::string> &rows) {
  line::RowsReader reader(line::csvSettings().characterUs());
  std::deque<line::Character> characters;
  std::vector<uint64_t> ends;
  for (const std::string &text : rows) {
    CHECK(reader.line(text, characters).empty());
    CHECK(characters.back().value == '\n');
    ends.push_back(characters.back().endUs);
  }
  return ends;
}

}  // namespace

TEST_CASE("a byte order mark before a text is no error") {
  const Recording recording = line::parseRecording(Mark + "120 0F E5\n");
  CHECK(recording.error.empty());
  REQUIRE(recording.characters.size() == 2);
  CHECK(recording.characters[0].endUs == 120);
  CHECK(line::parseRecording(Mark + "# a comment\n120 0F\n").error.empty());
  CHECK(line::parseRecording("120 0F\n" + Mark + "240 0F\n").errorLine == 2);
  CHECK(line::settingsIn(Mark + "# 200000 baud, 8E2\n").baud == 200000);
  CHECK(line::isCsvText(Mark + "1,2\n1,2\n"));
}

TEST_CASE("a board's line may have any baud rate") {
  CHECK(line::settingsIn("# 9600 baud, 8N1\n").baud == 9600);
  CHECK(line::settingsIn("# 9600 baud, 8N1\n").format == line::csvSettings().format);
  CHECK(line::settingsIn("# 115200 baud, 8N1\n") == line::csvSettings());
  CHECK(line::settingsIn("# 9600 baud, 8E2\n") == line::LineSettings());
  line::LineSettings oneStopBit;
  oneStopBit.format.stopBits = 1;
  CHECK(line::settingsIn("# 100000 baud, 8E1, inverted\n") == oneStopBit);
  CHECK(line::parseRecording("120 0F\n230 E0\n", oneStopBit.characterUs()).error == "");
  CHECK(line::parseRecording("120 0F\n230 E0\n").errorLine == 2);
}

TEST_CASE("a table of rows is distinguished from a recording") {
  CHECK(line::isCsvText("1,2\n1,2\n"));
  CHECK(line::isCsvText("a:1 b:2\na:1 b:2\n"));
  CHECK(line::isCsvText("seconds,CH1\n0.009,992\n"));
  CHECK(line::isCsvText("time,CH1\n"));
  CHECK_FALSE(line::isCsvText("120 00 11\n480 00 11\n"));  // bytes that are all digits
  CHECK_FALSE(line::isCsvText("120\t00\t11\n480\t00\t11\n"));
}

TEST_CASE("rows without times come five times a second, rows with times at those") {
  CHECK(rowEnds({"1,2", "3,4"}) == std::vector<uint64_t>{200000 + 3 * 86, 400000 + 3 * 86});
  CHECK(rowEnds({"seconds,CH1,CH2", "0.009000,992,1811", "0.018500,992,172", "3600.000001,1,2"}) ==
        std::vector<uint64_t>{8, 9000, 18500, 3600000001});
  CHECK(rowEnds({"time,CH1", "0.009,992", "0.008,993", "-1,994", "x,995"}) ==
        std::vector<uint64_t>{4, 9000, 9004, 9008, 9012});  // never back
}

TEST_CASE("a recording that begins below 0 keeps its times, and what is written of it has them again") {
  const std::string text = "# 100000 baud, 8E2, inverted\n-9380 0F E3\n-380 0F\n8620 1F!\n";
  const line::Recording recording = line::parseRecording(text);
  CHECK(recording.error == "");
  CHECK(recording.zeroUs == -9380 - 120);
  line::RecordingWriter writer;
  writer.setZero(recording.zeroUs);
  writer.opened(line::LineSettings());
  for (const line::Character character : recording.characters) {
    writer.put(character);
  }
  writer.finish();
  CHECK(writer.take() == text);
  CHECK(line::parseRecording("0 0F\n").zeroUs == 0);
  CHECK(line::parseRecording("-100 0F\n-300 0F\n").error ==
        "time -300 is too early: the previous character was complete at -100 us, and each takes 120 us");
  CHECK(line::parseRecording("-31622400000001 0F\n").error.find("is not a time") != std::string::npos);
}

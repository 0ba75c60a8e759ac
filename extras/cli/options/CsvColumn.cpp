#include "cli/options/CsvColumn.h"

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "cli/options/Subcommand.h"
#include "line/capture/Parsing.h"
#include "line/file/Units.h"

namespace tool {

namespace {

struct Name {
  const char *name;
  CsvColumn::Kind kind;
};
constexpr Name Names[] = {{"failsafe", CsvColumn::Kind::Failsafe}, {"lostframe", CsvColumn::Kind::LostFrame},
                          {"time", CsvColumn::Kind::Time},         {"state", CsvColumn::Kind::State},
                          {"age", CsvColumn::Kind::Age},           {"quality", CsvColumn::Kind::Quality}};

// Appends the columns that a word of the list names. Returns false if there are none.
bool append(const std::string &word, std::vector<CsvColumn> &columns) {
  for (const Name &each : Names) {
    if (word == each.name) {
      columns.push_back({each.kind, 0});
      return true;
    }
  }
  const size_t dash = word.find('-');
  const unsigned first = line::channelOf(word.substr(0, dash));
  const unsigned last = dash == std::string::npos ? first : line::channelOf(word.substr(dash + 1));
  for (unsigned channel = first; channel <= last && first > 0; channel++) {
    columns.push_back({CsvColumn::Kind::Channel, channel});
  }
  return first > 0 && first <= last;
}

std::string seconds(int64_t us) {
  char text[40];
  const auto size = static_cast<unsigned long long>(us < 0 ? -us : us);
  std::snprintf(text, sizeof text, "%s%llu.%06llu", us < 0 ? "-" : "", size / 1000000, size % 1000000);
  return text;
}

}  // namespace

unsigned valueOf(const line::Values &values, unsigned channel) {
  const bool isSwitch = channel > sbus::ProportionalCount && values.count == sbus::ProportionalCount;
  return isSwitch ? values.switches[channel - sbus::ProportionalCount - 1] : values.raw[channel - 1];
}

std::vector<CsvColumn> parseColumns(const std::string &text) {
  std::vector<CsvColumn> columns;
  line::forEachBetweenCommas(text, [&columns](std::string_view each) {
    const std::string word = line::lower(line::trimmed(each));
    if (!append(word, columns)) {
      rejectCommandLine(
          "--columns: \"" + word +
          "\" is not a column; there are ch1 to ch32, spans such as ch1-ch4, failsafe, lostframe, time, state, age "
          "and quality");
    }
  });
  return columns;
}

bool haveAllArrived(const std::vector<CsvColumn> &columns, const line::Values &values, uint64_t sinceFirstUs) {
  constexpr uint64_t SettledUs = 1000000;
  const unsigned most = values.count == sbus::ProportionalCount ? sbus::ChannelCount : values.count;
  for (const CsvColumn &column : columns) {
    if (column.kind != CsvColumn::Kind::Channel || column.channel <= most) {
      continue;
    }
    if (sinceFirstUs >= SettledUs) {
      throw std::runtime_error("--columns: ch" + std::to_string(column.channel) + " is missing: this line ends at ch" +
                               std::to_string(most) + "; leave it out");
    }
    return false;
  }
  return true;
}

std::string header(const std::vector<CsvColumn> &columns) {
  std::string line;
  for (const CsvColumn &column : columns) {
    const bool isChannel = column.kind == CsvColumn::Kind::Channel;
    const auto *const name = std::find_if(std::begin(Names), std::end(Names),
                                          [&column](const Name &each) { return each.kind == column.kind; });
    line += (line.empty() ? "" : ",") + (isChannel ? "CH" + std::to_string(column.channel) : std::string(name->name));
  }
  return line + '\n';
}

const char *stateName(sbus::LinkState state) {
  const char *const texts[] = {"never seen", "ok", "lossy", "failsafe", "stale"};
  return texts[static_cast<int>(state)];
}

std::string row(const std::vector<CsvColumn> &columns, line::Observer &observer, uint64_t nowUs, bool hasTimes,
                int64_t zeroUs) {
  const line::Values &values = observer.newest();
  const sbus::LinkState state = observer.state(nowUs);
  std::string line;
  for (const CsvColumn &column : columns) {
    line += line.empty() ? "" : ",";
    switch (column.kind) {
      case CsvColumn::Kind::Channel:
        line += std::to_string(valueOf(values, column.channel));
        break;
      case CsvColumn::Kind::Failsafe:
        line += state == sbus::LinkState::Failsafe ? '1' : '0';
        break;
      case CsvColumn::Kind::LostFrame:
        line += values.lostFrame ? '1' : '0';
        break;
      case CsvColumn::Kind::Time:
        line += hasTimes ? seconds(static_cast<int64_t>(nowUs) + zeroUs) : "-";
        break;
      case CsvColumn::Kind::State:
        line += stateName(state);
        break;
      case CsvColumn::Kind::Age:
        line += hasTimes ? seconds(static_cast<int64_t>(observer.ageUs(nowUs))) : "-";
        break;
      case CsvColumn::Kind::Quality:
        line += std::to_string(observer.linkQuality(nowUs));
        break;
    }
  }
  return line + '\n';
}

}  // namespace tool

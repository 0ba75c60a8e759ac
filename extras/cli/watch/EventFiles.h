// Names the files of `sbus watch` and removes the oldest.
#pragma once

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "line/Format.h"
#include "line/recording/WallTime.h"

namespace tool {

class EventFiles {
 public:
  // Creates the folder if needed, and keeps at most `mostBytes` in it. Throws std::runtime_error.
  EventFiles(std::string folder, uint64_t mostBytes) : _folder(std::move(folder)), _mostBytes(mostBytes) {
    std::error_code error;
    std::filesystem::create_directory(_folder, error);
    if (error || !std::filesystem::is_directory(_folder)) {
      throw std::runtime_error(_folder + ": cannot be created (" + (error ? error.message() : "it is a file") +
                               "); name a folder that can be written");
    }
  }

  // Removes the oldest files, makes the next one, and returns its name: "DIR/sbus-000042-2026-11-24T15-16-18Z.txt", without the
  // date if `beginUs`, in us since 1970, is unknown. Numbers only grow, so the order is right whatever the clock says.
  std::string next(std::optional<int64_t> beginUs) {
    std::map<unsigned long, std::filesystem::directory_entry> files;
    uint64_t bytes = 0;
    std::error_code error;
    for (const std::filesystem::directory_entry &entry : std::filesystem::directory_iterator(_folder, error)) {
      const unsigned long number = numberOf(entry.path().filename().string());
      if (number > 0) {
        files[number] = entry;
        bytes += entry.file_size(error);
      }
    }
    unsigned long number = files.empty() ? 1 : files.rbegin()->first + 1;
    while (!files.empty() && bytes > _mostBytes) {
      bytes -= std::min<uint64_t>(bytes, files.begin()->second.file_size(error));
      std::filesystem::remove(files.begin()->second.path(), error);
      files.erase(files.begin());
    }
    std::string date = beginUs ? "-" + line::wallTime(*beginUs).substr(0, 19) + "Z" : "";
    std::replace(date.begin(), date.end(), ':', '-');
    const auto name = [&] { return line::format("%s/sbus-%06lu", _folder.c_str(), number) + date + ".txt"; };
    while (isTaken(name())) {
      number++;
    }
    return name();
  }

 private:
  // Makes an empty file of this name, so that no other program takes it. Returns true if one has.
  static bool isTaken(const std::string &name) {
    std::FILE *const file = std::fopen(name.c_str(), "wx");
    return file == nullptr ? errno == EEXIST : std::fclose(file) != 0;
  }

  // Returns 42 for sbus-000042-2026-11-24T15-16-18Z.txt; 0 for other names. After 999999 a number has more digits.
  static unsigned long numberOf(const std::string &name) {
    constexpr int EndLeast = 11;  // of "sbus-000042"
    unsigned long number = 0;
    int end = 0;
    const bool is = std::sscanf(name.c_str(), "sbus-%9lu%n", &number, &end) == 1 && end >= EndLeast &&
                    std::strchr("-.", name[static_cast<size_t>(end)]) != nullptr &&
                    name.compare(name.size() - std::strlen(".txt"), std::string::npos, ".txt") == 0;
    return is ? number : 0;
  }

  const std::string _folder;
  const uint64_t _mostBytes;
};

}  // namespace tool

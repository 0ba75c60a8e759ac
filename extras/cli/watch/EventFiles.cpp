#include "cli/watch/EventFiles.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <utility>

#include "line/Format.h"
#include "line/recording/WallTime.h"

namespace tool {

namespace {

namespace fs = std::filesystem;

// Returns 42 for sbus-000042-2026-11-24T15-16-18Z.txt; 0 for other names. After 999999 a number has more digits.
unsigned long numberOf(const std::string &name) {
  constexpr int EndLeast = 11;  // of "sbus-000042"
  unsigned long number = 0;
  int end = 0;
  const bool is = std::sscanf(name.c_str(), "sbus-%9lu%n", &number, &end) == 1 && end >= EndLeast &&
                  std::strchr("-.", name[static_cast<size_t>(end)]) != nullptr &&
                  name.compare(name.size() - std::strlen(".txt"), std::string::npos, ".txt") == 0;
  return is ? number : 0;
}

}  // namespace

EventFiles::EventFiles(std::string folder, unsigned keep, uint64_t mostBytes)
    : _folder(std::move(folder)), _keep(keep), _mostBytes(mostBytes) {
  std::error_code error;
  fs::create_directory(_folder, error);
  if (error || !fs::is_directory(_folder)) {
    throw std::runtime_error(_folder + ": cannot be created (" + (error ? error.message() : "it is a file") +
                             "); name a folder that can be written");
  }
}

std::string EventFiles::next(std::optional<int64_t> beginUs) {
  std::map<unsigned long, fs::directory_entry> files;
  uint64_t bytes = 0;
  std::error_code error;
  for (const fs::directory_entry &entry : fs::directory_iterator(_folder, error)) {
    const unsigned long number = numberOf(entry.path().filename().string());
    if (number > 0) {
      files[number] = entry;
      bytes += entry.file_size(error);
    }
  }
  const unsigned long number = files.empty() ? 1 : files.rbegin()->first + 1;
  while (!files.empty() && (files.size() >= _keep || bytes > _mostBytes)) {
    bytes -= std::min<uint64_t>(bytes, files.begin()->second.file_size(error));
    fs::remove(files.begin()->second.path(), error);
    files.erase(files.begin());
  }
  std::string date = beginUs ? "-" + line::wallTime(*beginUs).substr(0, 19) + "Z" : "";
  std::replace(date.begin(), date.end(), ':', '-');
  return line::format("%s/sbus-%06lu", _folder.c_str(), number) + date + ".txt";
}

}  // namespace tool

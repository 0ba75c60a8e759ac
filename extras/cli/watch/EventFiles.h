// The files of `sbus watch`: their names, and how many stay.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace tool {

class EventFiles {
 public:
  // Keeps `keep` files and `mostBytes` in the folder, which it creates if needed. Throws std::runtime_error.
  EventFiles(std::string folder, unsigned keep, uint64_t mostBytes);

  // Returns the name of the next file, after it has removed the oldest ones:
  // "DIR/sbus-000042-2026-11-24T15-16-18Z.txt", without the date if `beginUs`, in us since 1970, is not known. Numbers
  // go on, so the order is right whatever the clock.
  std::string next(std::optional<int64_t> beginUs);

 private:
  const std::string _folder;
  const unsigned _keep;
  const uint64_t _mostBytes;
};

}  // namespace tool

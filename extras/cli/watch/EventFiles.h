// Names the files of `sbus watch` and removes the oldest.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace tool {

class EventFiles {
 public:
  // Creates the folder if needed, and keeps at most `keep` files and `mostBytes` in it. Throws std::runtime_error.
  EventFiles(std::string folder, unsigned keep, uint64_t mostBytes);

  // Removes the oldest files and returns the name of the next: "DIR/sbus-000042-2026-11-24T15-16-18Z.txt", without the
  // date if `beginUs`, in us since 1970, is unknown. Numbers only grow, so the order is right whatever the clock says.
  std::string next(std::optional<int64_t> beginUs);

 private:
  const std::string _folder;
  const unsigned _keep;
  const uint64_t _mostBytes;
};

}  // namespace tool

// Holds back stretches that may be telemetry until the following bytes decide, so that every subcommand counts the same
// slots.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "line/Observer.h"

namespace tool {

class PendingSlots {
 public:
  using Say = std::function<void(const line::Stretch &)>;

  PendingSlots(const line::Observer &observer, Say say) : _observer(observer), _say(std::move(say)) {}

  // Takes the next stretch from the observer's listener.
  void take(const line::Stretch &stretch) {
    if (!stretch.slots.empty()) {
      _held.push_back(stretch);
      return;
    }
    finish();
    _say(stretch);
  }

  // Releases the rest. Call it after Observer::finish().
  void finish() {
    const bool areSlots = !_observer.telemetry().proved().empty();
    for (line::Stretch &stretch : std::exchange(_held, {})) {
      if (!areSlots) {
        stretch.slots.clear();
      }
      _say(stretch);
    }
  }

 private:
  const line::Observer &_observer;
  const Say _say;
  std::vector<line::Stretch> _held;
};

}  // namespace tool

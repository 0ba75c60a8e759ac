// Which of two receivers flies, by the rules that boards have: sbus::ReceiverChoice.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "line/Observer.h"
#include "sbus/LinkQuality.h"
#include "sbus/ReceiverChoice.h"
#include "sbus/Trainer.h"

namespace tool {

// What was heard of a receiver.
struct Heard {
  line::Observer observer;
  uint64_t freshUs = 0;  // the end of the newest frame that may leave
  sbus::LinkQuality quality;
  sbus::Reception reception{};
  const char *misfit = nullptr;  // what the one that flies sends instead; null while both fit
  bool isMisfitSaid = false;
};

class Choice {
 public:
  // Judges both, and chooses one: with a trainer always the first, the teacher's. Call it for each frame and each tick;
  // `nowUs` may be a little earlier than in the previous call.
  void judge(Heard &first, Heard &second, sbus::Trainer *trainer, uint64_t nowUs) {
    _nowUs = std::max(_nowUs, nowUs);
    const Heard &flying = this->flying() == 0 ? first : second;
    for (Heard *const each : {&first, &second}) {
      const sbus::LinkState state = each->observer.state(_nowUs);
      each->misfit = misfit(*each, flying);
      each->reception = {each->freshUs > 0 && each->misfit == nullptr ? state : sbus::LinkState::NeverSeen,
                         static_cast<unsigned long>((_nowUs - each->freshUs) / 1000),
                         each->quality.update(each->observer.counters(), state, static_cast<uint32_t>(_nowUs))};
    }
    const auto ms = static_cast<uint32_t>(_nowUs / 1000);
    if (trainer != nullptr) {
      trainer->hear(second.reception, ms);
    } else {
      _choice.choose({first.reception, second.reception}, ms);
    }
  }

  size_t flying() const { return _choice.flying(); }

 private:
  static const char *misfit(const Heard &receiver, const Heard &flying) {
    if (receiver.freshUs > 0 && flying.freshUs > 0 && receiver.observer.has24() != flying.observer.has24()) {
      return "another number of channels";
    }
    const uint16_t *const raw = receiver.observer.newest().raw.data();
    return sbus::haveOtherRanges(raw, flying.observer.newest().raw.data()) ? "the other make's range" : nullptr;
  }

  sbus::ReceiverChoice<2> _choice;
  uint64_t _nowUs = 0;
};

}  // namespace tool

// Guides the user through a calibration in three steps: sbus/Calibrator.h decides, this class says what to do next.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "line/Statistics.h"
#include "sbus/Calibrator.h"

namespace tool {

class CalibrationGuide {
 public:
  using Say = std::function<void(const std::string &)>;

  // Announces the first step.
  explicit CalibrationGuide(Say say);

  // Takes an accepted frame, which ended at `nowUs`.
  void take(const line::Values &values, uint64_t nowUs);

  // Returns true during the first step, which pressEnter() ends.
  bool waitsForEnter() const { return _step == Step::Move; }
  void pressEnter();

  // Ends the other steps once they are complete, and says what is missing. Call it several times a second; `hasLink`:
  // frames are being received.
  void tick(uint64_t nowUs, bool hasLink);

  bool isDone() const { return _step == Step::Done; }

  // Returns the result. If it is incomplete, throws std::runtime_error that says what to do.
  sbus::Calibration calibration() const;

 private:
  enum class Step { Move, LetGo, Rest, Push, Done };  // LetGo: a second in which a movement may still end

  sbus::CalibrationError worst(sbus::CalibrationError next, std::string &text) const;
  void begin(Step step);
  void look();
  void sayOnce(const std::string &text);

  Say _say;
  sbus::Calibrator _calibrator;
  Step _step = Step::Move;
  uint64_t _lookUs = 0;  // when look() is due next
  uint64_t _nowUs = 0;
  std::string _said;
};

}  // namespace tool

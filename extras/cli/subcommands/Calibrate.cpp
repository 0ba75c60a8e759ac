// sbus calibrate: measures the raw values that a transmitter's sticks really send.

#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "cli/CalibrationFile.h"
#include "cli/Output.h"
#include "cli/options/SourceOption.h"
#include "cli/subcommands/Subcommands.h"
#include "line/Observer.h"
#include "line/Statistics.h"
#include "line/system/System.h"
#include "sbus/Calibrator.h"

namespace tool {

namespace {

using sbus::CalibrationError;

constexpr unsigned Sticks = 4;  // CH1 to CH4 must be good
constexpr uint64_t LookUs = 1000000;

// Guides the user through a calibration in three steps: sbus/Calibrator.h decides, this class says what to do next.
class CalibrationGuide {
 public:
  // Announces the first step.
  CalibrationGuide();

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

  CalibrationError worst(CalibrationError next, std::string &text) const;
  void begin(Step step);
  void look();
  void sayOnce(const std::string &text);

  sbus::Calibrator _calibrator;
  Step _step = Step::Move;
  uint64_t _lookUs = 0;  // when look() is due next
  uint64_t _nowUs = 0;
  std::string _said;
};

CalibrationGuide::CalibrationGuide() {
  _calibrator.setDeadZone(0);
  begin(Step::Move);
}

void CalibrationGuide::begin(Step step) {
  _step = step;
  _lookUs = _nowUs + LookUs;
  if (step == Step::Move) {
    _calibrator.begin();
    sayOnce(
        "1 of 3: Move all sticks, sliders and switches to all their ends. Then centre the sticks, throttle low, let "
        "go, and press Enter.");
  } else if (step == Step::LetGo || step == Step::Rest) {
    _calibrator.centre();
  } else if (step == Step::Push) {
    _calibrator.high();
    sayOnce("3 of 3: Push both sticks up and right, and hold them there.");
  }
}

void CalibrationGuide::sayOnce(const std::string &text) {
  if (std::exchange(_said, text) != text) {
    std::fprintf(stderr, "%s\n", text.c_str());
  }
}

void CalibrationGuide::take(const line::Values &values, uint64_t nowUs) {
  _nowUs = nowUs;
  _calibrator.feed(values.raw.data(), values.failsafe, values.lostFrame);
}

// Returns what the first incomplete stick lacks, with its message in `text`; `next` if this step is complete.
CalibrationError CalibrationGuide::worst(CalibrationError next, std::string &text) const {
  for (uint8_t i = 0; i < Sticks; i++) {
    sbus::CalibratedChannel calibrated;
    const CalibrationError error = _calibrator.result(i, calibrated);
    if (error != next) {
      text = "CH" + std::to_string(i + 1) + sbus::text(error);
      return error;
    }
  }
  return next;
}

void CalibrationGuide::pressEnter() {
  std::string text;
  if (worst(CalibrationError::NotRested, text) == CalibrationError::NotRested) {
    sayOnce("2 of 3: Hands off.");
    begin(Step::LetGo);
  } else {
    sayOnce(text + ". Then press Enter.");
  }
}

// Checks the channels at the end of a second. A step that can no longer be completed starts over.
void CalibrationGuide::look() {
  std::string text;
  const CalibrationError next = _step == Step::Push ? CalibrationError::None : CalibrationError::NotPushed;
  const CalibrationError error = worst(next, text);
  if (error == next) {
    begin(_step == Step::LetGo ? Step::Rest : _step == Step::Rest ? Step::Push : Step::Done);
    return;
  }
  sayOnce(text + ".");
  if (error == CalibrationError::MovedOneWay || error == CalibrationError::CentreOutside) {
    begin(Step::Move);
  } else if (_step == Step::Push) {
    _lookUs = _nowUs + LookUs;
  } else {
    begin(Step::LetGo);
  }
}

void CalibrationGuide::tick(uint64_t nowUs, bool hasLink) {
  _nowUs = nowUs;
  if (waitsForEnter() || isDone()) {
    return;
  }
  if (!hasLink) {
    sayOnce("The link is lost: switch the radio on.");
    _lookUs = nowUs + LookUs;
  } else if (nowUs >= _lookUs) {
    look();
  }
}

sbus::Calibration CalibrationGuide::calibration() const {
  std::string text;
  sbus::Calibration found;
  uint8_t channel = 0;
  if (!isDone()) {
    worst(CalibrationError::None, text);
    throw std::runtime_error("nothing was written, because the third step was not completed: " + text);
  }
  _calibrator.finish((1 << Sticks) - 1, found, channel);
  return found;
}

// Returns true if Enter was pressed. Throws std::runtime_error if standard input has ended.
bool isEnterPressed() {
  if (!line::isReadable(STDIN_FILENO, 0)) {
    return false;
  }
  char keys[100];
  const ssize_t count = read(STDIN_FILENO, keys, sizeof keys);
  if (count <= 0) {
    throw std::runtime_error("standard input has ended, so Enter cannot be pressed; run it in a terminal");
  }
  return std::find(keys, keys + count, '\n') != keys + count;
}

sbus::Calibration measure(Input &input) {
  CalibrationGuide guide;
  line::Observer observer;
  observer.reset(0, input.settings().characterUs());
  observer.listen([&](const line::Stretch &stretch) {
    if (stretch.isFrame()) {
      guide.take(observer.newest(), stretch.endUs());
    }
  });
  input.run([&](const line::Character &character) { observer.put(character); },
            [&](uint64_t nowUs) {
              observer.idleUntil(input.knownUs());
              if (!guide.waitsForEnter()) {
                guide.tick(nowUs, observer.hasLink(nowUs));
              } else if (isEnterPressed()) {
                guide.pressEnter();
              }
              if (guide.isDone()) {
                input.end();
              }
            });
  return guide.calibration();
}

void run(const SourceOption &source, const std::string &name) {
  if (source.name() == "-") {
    rejectCommandLine("-: standard input is where Enter is pressed; name a port or a file");
  }
  const std::unique_ptr<Input> input = source.open();
  // The file is opened first: if it cannot be written, the user learns it before moving the sticks.
  writeTo(name, File::New, [&](const Put &put) {
    const std::string text = calibrationText(measure(*input));
    put(text);
    std::fprintf(stderr, "%s:\n%s", name.empty() ? "-" : name.c_str(), text.c_str());
  });
}

}  // namespace

void addCalibrate(CLI::App &app) {
  Subcommand subcommand(app, "calibrate", "measures the ends and the centre of each channel, for joystick");
  const auto source = std::make_shared<SourceOption>(subcommand, Playback::RealTime, Rows::Rejected);
  const auto name = std::make_shared<std::string>();
  subcommand
      .option("-o,--output", *name, "the file to write; an existing file is not overwritten (standard output)")
      .type("FILE");
  subcommand.footer(
      "It guides you in three steps. CH1 to CH4 must be sticks; channels that hardly moved are left out.");
  subcommand.run([source, name] { run(*source, *name); });
}

}  // namespace tool

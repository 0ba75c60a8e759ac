// sbus hex: prints the bytes, 25 per line as in RealTerm, and what the decoder found in them.

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>
#include <string>

#include "cli/Json.h"
#include "cli/Output.h"
#include "cli/PendingSlots.h"
#include "cli/SilenceNote.h"
#include "cli/options/SourceOption.h"
#include "cli/subcommands/Subcommands.h"
#include "line/Format.h"
#include "line/Observer.h"

namespace tool {

namespace {

// Escape codes for colours. Colour alone never carries information.
struct Colours {
  const char *time = "";
  const char *rejected = "";
  const char *bad = "";
  const char *flags = "";
  const char *off = "";
};

Colours colours() {
  const auto is = [](const char *name, const char *value) {
    const char *const set = std::getenv(name);
    return set != nullptr && std::strcmp(set, value) == 0;
  };
  const bool shown = isTerminal() && !is("TERM", "dumb") && (std::getenv("NO_COLOR") == nullptr || is("NO_COLOR", ""));
  return shown ? Colours{"\x1b[2m", "\x1b[33m", "\x1b[31;7m", "\x1b[31m", "\x1b[0m"} : Colours{};
}

const char *kindText(line::Stretch::Kind kind) {
  return kind == line::Stretch::Kind::Frame     ? "frame"
         : kind == line::Stretch::Kind::Frame24 ? "frame24"
         : kind == line::Stretch::Kind::Extra   ? "extra"
                                                : "-";
}

constexpr size_t Row = sbus::FrameSize;  // bytes

struct HexOptions {
  bool values = false;
  bool json = false;
};

class HexView {
 public:
  HexView(const line::Observer &observer, const HexOptions &options, const SourceOption &source)
      : _observer(observer),
        _options(options),
        _hasTimes(source.hasTimes()),
        _zeroUs(source.zeroUs()),
        _colours(colours()) {}

  void show(const line::Stretch &stretch) {
    const int64_t us = static_cast<int64_t>(stretch.endUs()) + _zeroUs;
    const std::string time = _hasTimes ? line::format("%12.6f  ", line::seconds(us)) : line::format("%12s  ", "-");
    const size_t count = stretch.characters.size();
    const std::string colour = flags(stretch).empty() ? colourOf(stretch) : _colours.flags;
    write(_colours.time + time + _colours.off + bytes(stretch) +
          std::string((Row - std::min(count, Row)) * ByteWidth + 1, ' ') + colour + verdict(stretch) + flags(stretch) +
          (colour.empty() ? "" : _colours.off) + values(stretch) + '\n');
  }

 private:
  static constexpr size_t ByteWidth = 3;  // columns

  std::string bytes(const line::Stretch &stretch) const {
    const std::string colour = colourOf(stretch);
    std::string text = colour;
    for (const line::Character &character : stretch.characters) {
      const std::string byte = line::format("%02X", static_cast<unsigned>(character.value));
      text += character.bad ? _colours.bad + byte + "!" + _colours.off + colour : byte + " ";
    }
    return text + (colour.empty() ? "" : _colours.off);
  }

  const char *colourOf(const line::Stretch &stretch) const {
    return stretch.isFrame() || !stretch.slots.empty() ? "" : _colours.rejected;
  }

  // Returns the kind of the stretch, with the end byte of a frame, or what is wrong.
  static std::string verdict(const line::Stretch &stretch) {
    const std::string kind = kindText(stretch.kind);
    if (!stretch.isFrame()) {
      return kind + " " + why(stretch);
    }
    return kind + line::format(" end %02X", static_cast<unsigned>(stretch.characters.back().value)) +
           (stretch.kind == line::Stretch::Kind::Extra ? ", CH17..CH32" : "");
  }

  // Returns the flags that are set in a frame.
  std::string flags(const line::Stretch &stretch) const {
    if (!stretch.isFrame() || stretch.kind == line::Stretch::Kind::Extra) {
      return {};
    }
    const line::Values &values = _observer.newest();
    return std::string(values.lostFrame ? ", lost frame" : "") + (values.failsafe ? ", failsafe" : "");
  }

  // Returns the frame's raw values, with --values.
  std::string values(const line::Stretch &stretch) const {
    if (!stretch.isFrame() || !_options.values) {
      return {};
    }
    std::string text = "  #";  // a comment, to those who read the bytes again
    const size_t first = stretch.kind == line::Stretch::Kind::Extra ? sbus::ProportionalCount : 0;
    const size_t count = stretch.kind == line::Stretch::Kind::Frame24 ? sbus::ChannelCount24 : sbus::ProportionalCount;
    for (size_t channel = first; channel < first + count; channel++) {
      text += line::format(" %4u", static_cast<unsigned>(_observer.newest().raw[channel]));
    }
    return text;
  }

  const line::Observer &_observer;
  const HexOptions &_options;
  const bool _hasTimes;
  const int64_t _zeroUs;
  Colours _colours;
};

void writeJson(const line::Stretch &stretch, const line::Values &values, const SourceOption &source) {
  const auto known = [&source](uint64_t us) { return source.shownUs(us); };
  for (const line::TimedSlot &slot : stretch.slots) {
    write(slotJson(slot, known(slot.endUs)).line());
  }
  if (stretch.slots.empty()) {
    const std::optional<double> endUs = known(stretch.endUs());
    write((stretch.isFrame() ? frameJson(stretch, endUs, values) : noFrameJson(stretch, endUs)).line());
  }
}

void writeJsonEnd(const line::Observer &observer) {
  write(Json("end")
            .number("characters", observer.characters())
            .number("character_errors", observer.characterErrors())
            .counts(observer.counters())
            .line());
}

void run(const SourceOption &source, const HexOptions &options) {
  const std::unique_ptr<Input> input = source.open();
  if (options.json) {
    write(source.json().line());
    flush();
  }
  line::Observer observer;
  observer.reset(0, input->settings().characterUs());
  HexView view(observer, options, source);
  PendingSlots held(observer, [&](const line::Stretch &stretch) {
    options.json ? writeJson(stretch, observer.newest(), source) : view.show(stretch);
  });
  observer.listen([&held](const line::Stretch &stretch) { held.take(stretch); });
  SilenceNote silence(source.name(), "bytes", source.isFile());
  input->run([&observer](const line::Character &character) { observer.put(character); },
             [&](uint64_t nowUs) {
               observer.idleUntil(input->knownUs());
               silence.tick(nowUs, observer.characters() > 0);
             });
  observer.finish();
  held.finish();
  const bool isCut = source.isLive() && !source.isStream() && input->isBroken();  // a program that reads it must know
  if (options.json && !isCut) {
    writeJsonEnd(observer);
  }
  flush();
}

}  // namespace

void addHex(CLI::App &app) {
  Subcommand subcommand(app, "hex", "prints the bytes, 25 a line, and what was rejected and why");
  const auto source = std::make_shared<SourceOption>(subcommand, Playback::AtOnce);
  const auto options = std::make_shared<HexOptions>();
  const Option values =
      subcommand.flag("--values", options->values, "print the channels' raw values beside each frame");
  subcommand.flag("--json", options->json, "JSON lines: the frames, and the discarded bytes").excludes(values);
  subcommand.footer(
      "Each line has the time at which its last byte ended, in seconds, or - if unknown; the bytes, with ! after "
      "each with a wrong parity or stop bit; frame, frame24 (24 channels), extra (header 2F) or - for no frame; and "
      "the end byte or the reason.");
  subcommand.run([source, options] { run(*source, *options); });
}

}  // namespace tool

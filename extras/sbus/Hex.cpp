// sbus hex: the bytes, 25 a line, as RealTerm shows them; and what the decoder made of them.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "Output.h"
#include "SilenceNote.h"
#include "SourceOption.h"
#include "Subcommands.h"
#include "line/Observer.h"

namespace tool {

namespace {

// Of a terminal that shows colours; the text says the same without them.
struct Colours {
  const char *time = "";
  const char *rejected = "";
  const char *bad = "";
  const char *flags = "";
  const char *off = "";
};

Colours coloursOf(const std::string &when) {
  const auto is = [](const char *name, const char *value) {
    const char *const set = std::getenv(name);
    return set != nullptr && std::strcmp(set, value) == 0;
  };
  const bool shown = isTerminal() && !is("TERM", "dumb") && (std::getenv("NO_COLOR") == nullptr || is("NO_COLOR", ""));
  const bool wanted = when == "always" || (when == "auto" && shown);
  return wanted ? Colours{"\x1b[2m", "\x1b[33m", "\x1b[31;7m", "\x1b[31m", "\x1b[0m"} : Colours{};
}

const char *kindText(line::Stretch::Kind kind) {
  return kind == line::Stretch::Kind::Frame     ? "frame"
         : kind == line::Stretch::Kind::Frame24 ? "frame24"
         : kind == line::Stretch::Kind::Extra   ? "extra"
                                                : "-";
}

struct HexOptions {
  std::string colour = "auto";
  bool values = false;
  bool delta = false;
};

class HexView {
 public:
  HexView(const line::Observer &observer, const HexOptions &options)
      : _observer(observer), _options(options), _colours(coloursOf(options.colour)) {}

  void show(const line::Stretch &stretch) {
    const bool frame = stretch.isFrame();
    char time[40];
    std::snprintf(time, sizeof time, "%12.6f  ", static_cast<double>(stretch.endUs() - _lastUs) / 1e6);
    _lastUs = _options.delta ? stretch.endUs() : 0;
    std::string text = _colours.time + std::string(time) + _colours.off;
    text += frame ? "" : _colours.rejected;
    for (const line::Character &character : stretch.characters) {
      char byte[8];
      std::snprintf(byte, sizeof byte, "%02X", character.value);
      text += character.bad ? std::string(_colours.bad) + byte + "!" + _colours.off + (frame ? "" : _colours.rejected)
                            : std::string(byte) + " ";
    }
    for (size_t i = stretch.characters.size(); i < sbus::FrameSize; i++) {
      text += "   ";
    }
    text += " " + std::string(kindText(stretch.kind));
    text += frame ? verdict(stretch) : " " + why(stretch) + _colours.off;
    text += frame && _options.values ? values(stretch) : "";
    write(text + '\n');
  }

 private:
  // What the end of a frame says.
  std::string verdict(const line::Stretch &stretch) const {
    char end[16];
    std::snprintf(end, sizeof end, " end %02X", stretch.characters.back().value);
    std::string text = end;
    if (stretch.kind == line::Stretch::Kind::Extra) {
      return text + ", CH17..CH32";
    }
    const line::Values &values = _observer.newest();
    const std::string flags =
        std::string(values.lostFrame ? ", lost frame" : "") + (values.failsafe ? ", failsafe" : "");
    return text + (flags.empty() ? "" : _colours.flags + flags + _colours.off);
  }

  // The frame's channels, raw.
  std::string values(const line::Stretch &stretch) const {
    const bool extra = stretch.kind == line::Stretch::Kind::Extra;
    const size_t first = extra ? sbus::ProportionalCount : 0;
    const size_t count =
        stretch.kind == line::Stretch::Kind::Frame24 ? sbus::ChannelCount24 : sbus::ProportionalCount;
    std::string text = " ";
    for (size_t channel = first; channel < first + count; channel++) {
      char value[8];
      std::snprintf(value, sizeof value, " %4u", static_cast<unsigned>(_observer.newest().raw[channel]));
      text += value;
    }
    return text;
  }

  const line::Observer &_observer;
  const HexOptions &_options;
  Colours _colours;
  uint64_t _lastUs = 0;  // what times are counted from
};

void run(const SourceOption &source, const HexOptions &options) {
  const std::unique_ptr<Input> input = source.open();
  line::Observer observer;
  observer.reset(0, input->settings().characterUs());
  HexView view(observer, options);
  observer.listen([&view](const line::Stretch &stretch) { view.show(stretch); });
  SilenceNote silence(source.name(), "bytes");
  input->run([&observer](const line::Character &character) { observer.put(character); },
             [&](uint64_t nowUs) {
               observer.idleUntil(input->knownUs());
               silence.tick(nowUs, observer.characters() > 0);
             });
  observer.finish();
  flush();
}

}  // namespace

void addHex(CLI::App &app) {
  CLI::App *const subcommand = app.add_subcommand("hex", "the bytes, 25 a line, and what was rejected and why");
  const auto source = std::make_shared<SourceOption>(*subcommand, Recordings::AtOnce);
  const auto options = std::make_shared<HexOptions>();
  subcommand->add_flag("--values", options->values, "the raw values of a frame's channels behind it");
  subcommand->add_flag("--delta", options->delta, "the time since the line before, not since the beginning");
  subcommand->add_option("--color", options->colour, "auto: on a terminal (auto)")
      ->check(CLI::IsMember({"auto", "always", "never"}).description(""))
      ->type_name("auto|always|never");
  subcommand->footer(
      "A line: the time of its last byte in seconds; the bytes, ! after one with a wrong parity or stop bit; "
      "frame, frame24 (24 channels), extra (header 2F) or - for none; the end byte or the reason.");
  subcommand->callback([source, options] { run(*source, *options); });
}

}  // namespace tool

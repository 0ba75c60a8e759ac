// Runs a sketch on a simulated Arduino Mega, with a line at Serial1. What the sketch sends over Serial is standard
// output, all else standard error. Fails if the sketch sets a port wrongly, does not fetch characters in time, or makes
// of the line what Expected.h does not expect.

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <memory>
#include <utility>

#include "Eeprom.h"
#include "Expected.h"
#include "LineInput.h"
#include "LineOutput.h"
#include "LineVariants.h"
#include "Mega.h"
#include "Options.h"
#include "Pulses.h"
#include "board/JumperWire.h"

namespace {

using mega::Options;

constexpr unsigned long SerialBaud = 115200;
constexpr unsigned long SerialBaudError = 40;  // 1/40: an AVR at 16 MHz sends at 117647, 2.1 % too fast

std::unique_ptr<line::Line> makeLine(const Options &options) {
  std::unique_ptr<line::Line> line = options.source.open();
  if (options.bad >= 0) {
    line = std::make_unique<mega::OneBadCharacter>(std::move(line), static_cast<unsigned long>(options.bad));
  }
  if (options.cut > 0) {
    line = std::make_unique<mega::CutLine>(std::move(line), static_cast<uint64_t>(options.cut * 1e6));
  }
  return line;
}

// The Mega with all that is connected to it.
class WiredMega {
 public:
  explicit WiredMega(const Options &options)
      : _options(options),
        _mega(options.elf),
        _line(options.wireFrom == 0 ? makeLine(options) : nullptr),
        _input(_mega, options.wireFrom == 0 ? *_line : _jumper),
        _outputs{{_mega, 0}, {_mega, 1}, {_mega, 2}, {_mega, 3}},
        _eeprom(_mega),
        _expected(std::filesystem::path(options.elf).stem().string(), _mega, _eeprom),
        _pulses(_mega, _expected) {
    _input.onFrame([this](const Frame &frame) { _expected.frame(frame, _input.others()); });
    _outputs[0].onCharacter([this](uint8_t byte, avr_cycle_count_t) { print(byte); });
    if (options.wireFrom != 0) {
      connect(options.wireFrom);
    } else {
      _outputs[2].onCharacter([this](uint8_t byte, avr_cycle_count_t) { send(byte); });
    }
    if (!options.eeprom.empty()) {
      _eeprom.load(options.eeprom);
    }
  }

  // Returns whether all went well.
  bool run() {
    const uint64_t endUs = static_cast<uint64_t>(_options.seconds * 1e6);
    while (_options.seconds > 0 ? _mega.clockUs() < endUs : !_line->finished(_mega.clockUs())) {
      _mega.run();
    }
    _eeprom.save();
    report();
    const bool settings = judge();
    return _expected.report() && settings && std::fflush(stdout) == 0;
  }

 private:
  void connect(int number) {
    _outputs[number].onSettings([this](const line::LineSettings &settings) { _input.rewire(settings); });
    _outputs[number].onCharacter([this](uint8_t byte, avr_cycle_count_t end) {
      line::Character character;
      character.endUs = (end - _mega.clockZero()) / mega::CyclesPerUs + 1;  // rounded up: then it really is through
      character.value = byte;
      _jumper.put(character);
      _input.look();
    });
  }

  void send(uint8_t byte) {
    _sentWrongly = _sentWrongly || !(_mega.settings(2) == line::LineSettings());
    _expected.sent(byte);
  }

  void print(uint8_t byte) {
    if (_lineBegins && _options.frames) {
      std::fprintf(stderr, "frames since begin(): %lu\n", _input.framesSinceOpen());
    }
    _lineBegins = byte == '\n';
    _expected.printed(static_cast<char>(byte));
    std::putchar(byte);
  }

  void report() const {
    std::fprintf(stderr, "line: %lu frames, the last through at %llu us; %lu characters, %lu of them bad\n",
                 _input.frames(), static_cast<unsigned long long>(_input.lastFrameUs()), _input.characters(),
                 _input.badCharacters());
  }

  // Serial: 115200 baud as near as the processor comes to it, 8N1.
  bool isSerialRight() const {
    const line::LineSettings settings = _mega.settings(0);
    const unsigned long error = settings.baud > SerialBaud ? settings.baud - SerialBaud : SerialBaud - settings.baud;
    return error <= SerialBaud / SerialBaudError && settings.format == line::Format{8, line::Parity::None, 1};
  }

  bool judge() const {
    bool good = true;
    if (!isSerialRight()) {
      std::fprintf(stderr, "Serial is not set to 115200 baud, 8N1, but to %s\n", text(_mega.settings(0)).c_str());
      good = false;
    }
    if (!_input.wrongSettings().empty() && !_options.anySettings) {
      std::fprintf(stderr, "Serial1 was set wrongly: %s\n", _input.wrongSettings().c_str());
      good = false;
    }
    if (_sentWrongly) {
      std::fprintf(stderr, "Serial2 is not set to S.Bus, but to %s\n", text(_mega.settings(2)).c_str());
      good = false;
    }
    if (_input.overruns() != 0) {
      std::fprintf(stderr, "Serial1 lost %lu characters that were not fetched in time\n", _input.overruns());
      good = false;
    }
    return good;
  }

  const Options &_options;
  mega::Mega _mega;
  std::unique_ptr<line::Line> _line;  // null if a wire has taken its place
  host::JumperWire _jumper;
  mega::LineInput _input;
  mega::LineOutput _outputs[4];
  mega::Eeprom _eeprom;
  mega::Expected _expected;
  mega::Pulses _pulses;
  bool _lineBegins = true;
  bool _sentWrongly = false;
};

}  // namespace

int main(int argc, char **argv) {
  try {
    const Options options = mega::parseOptions(argc, argv);
    return WiredMega(options).run() ? EXIT_SUCCESS : EXIT_FAILURE;
  } catch (const std::exception &error) {
    std::fprintf(stderr, "%s\n", error.what());
    return EXIT_FAILURE;
  }
}

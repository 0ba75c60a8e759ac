// sbus wave: writes the wire of a recording as a value change dump (VCD), for a logic analyser's software.

#include <memory>

#include "cli/Output.h"
#include "cli/options/SourceOption.h"
#include "cli/subcommands/Subcommands.h"
#include "line/capture/VcdWriter.h"

namespace tool {

namespace {

void run(const SourceOption &source, const std::string &output) {
  rejectSameFile(source.name(), output);
  const line::LineSettings settings = source.lineSettings();
  const std::unique_ptr<Input> input = source.open(settings);
  writeTo(output, File::Any, [&](const Put &put) {
    line::VcdWriter writer(settings);
    input->run([&](const line::Character &character) { put(writer.put(character)); }, [](uint64_t) {});
    put(writer.finish());
  });
}

}  // namespace

void addWave(CLI::App &app) {
  Subcommand subcommand(app, "wave",
                        "writes the wire of a recording or another capture as VCD, for PulseView and similar programs");
  const auto source = std::make_shared<SourceOption>(subcommand, Playback::AtOnce);
  const auto output = std::make_shared<std::string>();
  subcommand.option("-o,--output", *output, "a file (standard output)").type("FILE.vcd");
  subcommand.run([source, output] { run(*source, *output); });
}

}  // namespace tool

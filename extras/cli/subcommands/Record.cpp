// sbus record: saves a line as a recording, or a sketch's rows as CSV.

#include <cstdio>
#include <memory>

#include "cli/LineRecorder.h"
#include "cli/Output.h"
#include "cli/SilenceNote.h"
#include "cli/options/SourceOption.h"
#include "cli/subcommands/Subcommands.h"
#include "line/Format.h"

namespace tool {

namespace {

void run(const SourceOption &source, const std::string &file) {
  const std::string name = file.empty() ? "-" : file;
  const std::unique_ptr<Input> input = source.open();
  writeTo(name, File::New, [&](const Put &put) {
    LineRecorder recorder("record " + source.name(), input->settings(), source.isFile() && source.isWire(),
                          source.hasTimes(), source.startUs(), source.zeroUs(), put);
    std::fprintf(stderr, "%s: recording; Ctrl-C ends it\n", name.c_str());
    SilenceNote silence(source.name(), "frames", source.isFile());
    uint64_t endUs = 0;
    const bool isFile = source.isFile();  // a file ends with its last character, however long reading takes
    input->run(
        [&](const line::Character &character) {
          recorder.put(character);
          endUs = character.endUs;
        },
        [&](uint64_t nowUs) {
          endUs = isFile ? endUs : nowUs;
          recorder.idleUntil(input->knownUs());
          silence.tick(nowUs, recorder.recognised());
        });
    recorder.finish();
    const std::string time = source.hasTimes() ? line::format("%.1f s, ", line::seconds(endUs)) : "";
    std::fprintf(stderr, "%s: %s%s\n", name.c_str(), time.c_str(), recorder.summary().c_str());
  });
}

}  // namespace

void addRecord(CLI::App &app) {
  Subcommand subcommand(app, "record", "records a line in a text file, or a sketch's rows as CSV");
  const auto source = std::make_shared<SourceOption>(subcommand, Playback::AtOnce);
  source->addRows(subcommand);
  const auto name = std::make_shared<std::string>();
  subcommand.option("-o,--output", *name, "the recording; an existing file is not overwritten (standard output)")
      .type("FILE");
  subcommand.footer(
      "The file grows with every frame, and stays valid after Ctrl-C, which may cut the last frame, when the disk "
      "fills up, and if the program is killed.");
  subcommand.run([source, name] { run(*source, *name); });
}

}  // namespace tool

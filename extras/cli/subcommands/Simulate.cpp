// sbus simulate: sends what the built-in receiver would.

#include <memory>
#include <utility>

#include "cli/options/LineOptions.h"
#include "cli/Sending.h"
#include "cli/subcommands/Subcommands.h"
#include "line/uart/SampledLine.h"

namespace tool {

void addSimulate(CLI::App &app) {
  Subcommand subcommand(app, "simulate", "sends what the built-in receiver would, until Ctrl-C");
  struct Options {
    explicit Options(Subcommand &each) : line(each), sending(each) {}
    LineOptions line;
    Sending sending;
    double seconds = 0;
  };
  const auto options = std::make_shared<Options>(subcommand);
  subcommand.option("--seconds", options->seconds, "end after this many seconds").seconds().type("S");
  subcommand.run([options] {
    options->sending.run(
        [&options] {
          const line::Source source = options->line.source(options->line.settings());
          line::LineSettings port;
          port.baud = source.settings.baud;
          auto line = std::make_unique<line::SampledLine>(source.open(), source.settings, port);
          return std::make_unique<Input>(std::move(line), port, Input::Pace::True, options->seconds);
        },
        false);
  });
}

}  // namespace tool

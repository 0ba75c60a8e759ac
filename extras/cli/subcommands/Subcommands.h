// Adds the subcommands of `sbus`. A subcommand's callback does the work, and throws std::runtime_error with a message
// that says what happened, where, and what to do.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace tool {

// Returns "/dev/ttyUSB0" and the like; nothing if the system does not list its ports.
std::vector<std::string> portNames();

void addPorts(CLI::App &app);
void addMonitor(CLI::App &app);
void addHex(CLI::App &app);
void addCsv(CLI::App &app);
void addRecord(CLI::App &app);
void addWatch(CLI::App &app);
void addSend(CLI::App &app);
void addBridge(CLI::App &app);
void addDecode(CLI::App &app);
void addWave(CLI::App &app);
void addDoctor(CLI::App &app);
void addSummary(CLI::App &app);
void addCompare(CLI::App &app);
void addTelemetry(CLI::App &app);

}  // namespace tool

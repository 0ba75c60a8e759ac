// The sending half of a port: its transmit buffer, and what it has sent through its TX pin.
#pragma once

#include <deque>
#include <memory>
#include <string>

#include "BoardTransmitter.h"
#include "PortSettings.h"
#include "line/Observer.h"
#include "line/recording/RecordingFile.h"

namespace host {

// What was sent while the port had certain settings.
struct Transmission {
  PortSettings settings;
  line::Observer observer;
};

class Sender {
 public:
  Sender();

  // Records all that is sent in this file.
  void record(std::unique_ptr<line::RecordingFile> file);

  void open(uint64_t nowUs, const PortSettings &settings);
  void close() { _transmitter.close(); }

  // Takes the next character that was sent by `nowUs`; returns false without one.
  bool next(uint64_t nowUs, line::Character &character);

  // Takes the next character that has begun by `nowUs`.
  bool begun(uint64_t nowUs, line::Character &character);

  BoardTransmitter &transmitter() { return _transmitter; }

  // For the report.
  std::deque<Transmission> &transmissions() { return _transmissions; }  // one for each of the settings used
  std::string finish() { return _file ? _file->finish() : ""; }         // what has gone wrong with the file, or nothing

 private:
  BoardTransmitter _transmitter;
  uint8_t _dataMask = 0xFF;  // the bits of a byte that are sent
  std::deque<Transmission> _transmissions;
  Transmission *_transmission = nullptr;  // the one with the current settings
  std::unique_ptr<line::RecordingFile> _file;
};

}  // namespace host

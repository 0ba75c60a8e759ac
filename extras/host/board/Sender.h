// The sending half of a port: its transmit buffer, and the characters sent through its TX pin.
#pragma once

#include <deque>
#include <memory>
#include <string>

#include "BoardTransmitter.h"
#include "PortSettings.h"
#include "line/Observer.h"
#include "line/recording/RecordingFile.h"

namespace host {

// The characters sent with certain settings.
struct Transmission {
  PortSettings settings;
  line::Observer observer;
};

class Sender {
 public:
  // Records everything sent in this file.
  void record(std::unique_ptr<line::RecordingFile> file);

  void open(uint64_t nowUs, const PortSettings &settings);
  void close() { _transmitter.close(); }

  // Takes the next character sent by `nowUs`; returns false without one.
  bool next(uint64_t nowUs, line::Character &character);

  // Takes the next character that began by `nowUs`.
  bool begun(uint64_t nowUs, line::Character &character);

  BoardTransmitter &transmitter() { return _transmitter; }

  // For the report.
  std::deque<Transmission> &transmissions() { return _transmissions; }  // one for each of the settings used
  std::string finish() { return _file ? _file->finish() : ""; }         // the file's error, if any

 private:
  BoardTransmitter _transmitter;
  uint8_t _dataMask = 0xFF;  // the transmitted bits of a byte
  std::deque<Transmission> _transmissions;
  Transmission *_transmission = nullptr;  // the one with the current settings
  std::unique_ptr<line::RecordingFile> _file;
};

}  // namespace host

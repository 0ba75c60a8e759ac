// A USB adapter with an FTDI chip under Linux: it delivers its bytes when it has 62, or when its latency timer expires,
// which restarts with every packet.
//
// Linux 6.12, drivers/usb/serial/ftdi_sio.c: ftdi_port_probe() sets 16 ms, write_latency_timer() 1 ms for a port with
// ASYNC_LOW_LATENCY; ftdi_process_read_urb() takes packets of 64 bytes, two of them status.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "line/Line.h"
#include "line/simulation/Random.h"

// The result of a read(): one packet, or several if the program is late.
struct Read {
  uint64_t us;
  std::vector<line::Character> characters;
};

class Adapter {
 public:
  static constexpr size_t PacketMax = 62;

  Adapter(uint32_t latencyUs, line::Random &random)
      : _latencyUs(latencyUs), _random(random), _timerUs(random.below(latencyUs)) {}

  // Takes the next character of the line. Calls `hand` with each packet delivered before it is complete.
  template <typename Hand>
  void put(const line::Character &character, Hand hand) {
    runTo(character.endUs, hand);
    _characters.push_back(character);
    if (_characters.size() == PacketMax) {
      send(character.endUs, hand);
    }
  }

  // Takes the time up to which there are no further characters.
  template <typename Hand>
  void runTo(uint64_t us, Hand hand) {
    while (_timerUs <= us) {
      send(_timerUs, hand);
    }
  }

 private:
  template <typename Hand>
  void send(uint64_t us, Hand hand) {
    _timerUs = us + _latencyUs;
    if (!_characters.empty()) {
      _readUs = std::max(_readUs + 1, us + _random.below(UsbUs));
      hand(Read{_readUs, std::move(_characters)});
      _characters.clear();
    }
  }

  static constexpr uint32_t UsbUs = 1000;  // a frame of full speed

  const uint32_t _latencyUs;
  line::Random &_random;
  uint64_t _timerUs;  // when the timer runs out
  uint64_t _readUs = 0;
  std::vector<line::Character> _characters;
};

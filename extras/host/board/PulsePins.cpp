#include "PulsePins.h"

#include "line/simulation/Choreography.h"
#include "sbus/Frame.h"
#include "sbus/Scaling.h"

namespace host {

void PulsePins::onEdge(uint32_t pin, void (*callback)(), Edge edge) {
  if (pin - First < Count) {
    _callbacks[pin - First] = callback;
    _edges[pin - First] = edge;
  }
}

bool PulsePins::isHigh(uint32_t pin) const { return pin - First < Count && _isHigh[pin - First]; }

void PulsePins::connect() { plan(); }

// Returns the time of the next edge in the simulated flight.
uint32_t PulsePins::flightMs() const { return static_cast<uint32_t>(_frame * PeriodUs / 1000 % line::Flight.periodMs); }

void PulsePins::plan() {
  uint16_t channels[sbus::ChannelCount] = {};
  line::Flight.move(0, flightMs(), channels);
  const auto widthUs = static_cast<uint64_t>(sbus::toMicroseconds(channels[_edge / 2], sbus::FrSky));
  _nextUs = (_frame + 1) * PeriodUs + _edge / 2 * PitchUs + (_edge % 2 == 0 ? 0 : widthUs);
}

void PulsePins::advance(uint64_t nowUs) {
  while (_nextUs <= nowUs) {
    const uint32_t pin = _edge / 2;
    const bool isHigh = _edge % 2 == 0 && line::Flight.radio(0, flightMs()) == line::Radio::Received;
    const bool asked = _edges[pin] == Change || _edges[pin] == (isHigh ? Rising : Falling);
    _waits[pin] = _waits[pin] || (isHigh != _isHigh[pin] && asked);
    _isHigh[pin] = isHigh;
    _edge = (_edge + 1) % (2 * Count);
    _frame += _edge == 0;
    plan();
  }
}

void PulsePins::callBack() {
  for (uint32_t pin = 0; pin < Count; pin++) {
    if (_waits[pin] && _callbacks[pin] != nullptr) {
      _waits[pin] = false;
      _callbacks[pin]();
    }
  }
}

}  // namespace host

#include "Sender.h"

#include <algorithm>
#include <utility>

namespace host {

void Sender::record(std::unique_ptr<line::RecordingFile> file) {
  _file = std::move(file);
  if (_transmitter.isOpen()) {
    _file->opened(_transmission->settings.tx);  // a constructor in the sketch opened it before main()
  }
}

void Sender::open(uint64_t nowUs, const PortSettings &settings) {
  _transmitter.open(settings.tx.characterNs());
  _dataMask = static_cast<uint8_t>((1u << settings.tx.format.dataBits) - 1);
  const auto same =
      std::find_if(_transmissions.begin(), _transmissions.end(),
                   [&settings](const Transmission &transmission) { return transmission.settings == settings; });
  if (same == _transmissions.end()) {
    _transmission = &_transmissions.emplace_back();
    _transmission->settings = settings;
    _transmission->observer.reset(nowUs, settings.tx.characterUs());
  } else {
    _transmission = &*same;
  }
  if (_file) {
    _file->opened(settings.tx);
  }
}

bool Sender::begun(uint64_t nowUs, line::Character &character) {
  const bool any = _transmitter.begun(nowUs, character);
  character.value &= _dataMask;
  return any;
}

bool Sender::next(uint64_t nowUs, line::Character &character) {
  if (!_transmitter.next(nowUs, character)) {
    return false;
  }
  character.value &= _dataMask;
  _transmission->observer.put(character);
  if (_file) {
    _file->put(character);
  }
  return true;
}

}  // namespace host

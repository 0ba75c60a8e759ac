#include "line/capture/CaptureText.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "line/capture/Parsing.h"

namespace line {

namespace {

constexpr size_t BlockSize = size_t{1} << 20;

// Returns true if the first characters of a capture are enough to recognise its format.
bool isHead(std::string_view text) { return trimmed(text).substr(0, 1) == "$" || text.size() >= CaptureHeadMax; }

}  // namespace

CaptureText::CaptureText(std::string name, const Overrides &overrides, WireDecoder &decoder)
    : _name(std::move(name)), _overrides(overrides), _decoder(decoder), _block(BlockSize) {}

bool CaptureText::put(std::string_view bytes) {
  while (!bytes.empty() && _error.empty() && _rejection.empty()) {
    const size_t count = std::min(bytes.size(), _block.size() - _filled);
    std::copy_n(bytes.data(), count, _block.data() + _filled);
    bytes.remove_prefix(count);
    _filled += count;
    const std::string_view text(_block.data(), _filled);
    if (_filled == _block.size() || !(_reader ? _reader->needsFullBlocks() : !isHead(text))) {
      take(true);
    }
  }
  return _error.empty() && _rejection.empty();
}

void CaptureText::take(bool more) {
  std::string_view text(_block.data(), _filled);
  if (!_reader) {
    OpenedCapture opened = openCapture(text.substr(0, CaptureHeadMax), _decoder, _overrides);
    _reader = std::move(opened.reader);
    _rejection = opened.error;
    if (!_reader) {
      return;
    }
  }
  if (more) {
    text = text.substr(0, text.rfind('\n') + 1);
    if (text.empty() && _filled == _block.size()) {
      _rejection = "line " + std::to_string(_reader->lines() + 1) + " is longer than " + std::to_string(BlockSize) +
                   " characters: is this text?";
    }
    if (text.empty()) {
      return;
    }
  }
  _error = _reader->put(text);
  _cutOff = !_error.empty() && text.back() != '\n';
  _filled -= text.size();
  std::memmove(_block.data(), text.data() + text.size(), _filled);
}

CaptureEnd CaptureText::finish(const std::string &failure) {
  if (_error.empty() && _rejection.empty()) {
    take(false);
  }
  CaptureEnd end;
  if (!_rejection.empty()) {
    end.rejection = _name + ": " + (failure.empty() || _reader ? _rejection : failure);
    return end;
  }
  _error = _error.empty() ? _reader->finish() : _error;
  const std::string place = _name + ":" + std::to_string(_reader->lines()) + ": ";
  end.error = _error.empty() ? "" : place + (_cutOff ? "the capture ends within this line: " : "") + _error;
  end.isCut = _cutOff && !_error.empty() && failure.empty();
  end.error = failure.empty() ? end.error : _name + ": " + failure;
  _decoder.finish(_reader->endNs(), !end.error.empty());
  end.format = _reader->format();
  end.periodNs = _reader->periodNs();
  return end;
}

}  // namespace line

#include "RecordingWriter.h"

namespace line {

void RecordingWriter::opened(const LineSettings &settings) {
  _text.opened(settings, _pending);
  write();
}

void RecordingWriter::put(const Character &character) {
  _text.put(character, _pending);
  write();
}

void RecordingWriter::finish() {
  _text.finish(_pending);
  write();
}

void RecordingWriter::write() {
  _out << _pending;
  _pending.clear();
}

}  // namespace line

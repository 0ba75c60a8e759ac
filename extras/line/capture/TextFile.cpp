#include "line/capture/TextFile.h"

namespace line {

std::string_view TextFile::read() {
  while (!_atEnd) {
    const std::string_view bytes = _file.read();
    _atEnd = bytes.empty();
    const std::string_view text = _atEnd ? _plain.finish() : _plain.put(bytes);
    if (!text.empty()) {
      return text;
    }
  }
  return {};
}

std::string TextFile::read(size_t size) {
  std::string all;
  for (std::string_view text = read(); !text.empty() && all.size() < size; text = read()) {
    all += text;
  }
  return all.substr(0, size);
}

void forEachLine(PackedFile &file, const std::function<void(std::string_view)> &take) {
  TextFile text(file);
  std::string rest;  // the beginning of an incomplete line
  for (std::string_view read = text.read(); !read.empty(); read = text.read()) {
    for (size_t end = read.find('\n'); end != std::string_view::npos; end = read.find('\n')) {
      rest += read.substr(0, end);
      take(rest);
      rest.clear();
      read.remove_prefix(end + 1);
    }
    rest += read;
  }
  file.requireEnd();
  if (!rest.empty()) {
    take(rest);
  }
}

}  // namespace line

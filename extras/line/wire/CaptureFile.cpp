#include "CaptureFile.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>

namespace line {

namespace {

constexpr size_t BlockSize = size_t{1} << 20;

using File = std::unique_ptr<std::FILE, int (*)(std::FILE *)>;

File open(const std::string &name) {
  if (name == "-") {
    return File(stdin, [](std::FILE *) { return 0; });
  }
  File file(std::fopen(name.c_str(), "rb"), std::fclose);
  if (!file) {
    throw std::runtime_error(name + ": cannot be opened (" + std::strerror(errno) +
                             "); the name of a capture is expected");
  }
  return file;
}

}  // namespace

CaptureEnd readCapture(const std::string &name, const Overrules &overrules, WireDecoder &decoder) {
  const File file = open(name);
  CaptureEnd end;
  std::unique_ptr<CaptureReader> reader;
  std::vector<char> block(BlockSize);
  size_t filled = 0;
  bool more = true;
  bool cutOff = false;
  while (more && end.error.empty()) {
    errno = 0;
    const size_t count = std::fread(block.data() + filled, 1, block.size() - filled, file.get());
    if (std::ferror(file.get()) != 0) {
      throw std::runtime_error(name + ": cannot be read (" + std::strerror(errno) + ")");
    }
    filled += count;
    more = filled == block.size();
    std::string_view text(block.data(), filled);
    if (!reader) {
      OpenedCapture opened = openCapture(text.substr(0, CaptureHeadMax), decoder, overrules);
      if (!opened.error.empty()) {
        throw std::runtime_error(name + ": " + opened.error);
      }
      reader = std::move(opened.reader);
    }
    if (more) {
      text = text.substr(0, text.rfind('\n') + 1);
      if (text.empty()) {
        throw std::runtime_error(name + ": line " + std::to_string(reader->lines() + 1) + " is longer than " +
                                 std::to_string(BlockSize) + " characters: is this text?");
      }
    }
    end.error = reader->put(text);
    cutOff = !end.error.empty() && text.back() != '\n';
    filled -= text.size();
    std::memmove(block.data(), text.data() + text.size(), filled);
  }
  const std::string place = name + ":" + std::to_string(reader->lines()) + ": ";
  if (end.error.empty()) {
    end.error = reader->finish();
  }
  end.error = end.error.empty() ? "" : place + (cutOff ? "the capture ends within this line: " : "") + end.error;
  decoder.finish(reader->endNs(), !end.error.empty());
  end.format = reader->format();
  end.periodNs = reader->periodNs();
  return end;
}

}  // namespace line

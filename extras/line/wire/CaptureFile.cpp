#include "CaptureFile.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <memory>
#include <stdexcept>

#include "Text.h"

namespace line {

namespace {

constexpr size_t BlockSize = size_t{1} << 20;

// Takes what has come, as a pipe brings it.
class File {
 public:
  explicit File(const std::string &name) : _name(name), _file(name == "-" ? STDIN_FILENO : open(name.c_str(), O_RDONLY)) {
    if (_file < 0) {
      throw std::runtime_error(name + ": cannot be opened (" + std::strerror(errno) +
                               "); the name of a capture is expected");
    }
  }
  ~File() {
    if (_file != STDIN_FILENO) {
      close(_file);
    }
  }
  File(const File &) = delete;
  File &operator=(const File &) = delete;

  // Waits for a byte or more. Returns how many there are; 0 at the end.
  size_t read(char *at, size_t most) {
    ssize_t count;
    do {
      count = ::read(_file, at, most);
    } while (count < 0 && errno == EINTR);
    if (count < 0) {
      throw std::runtime_error(_name + ": cannot be read (" + std::strerror(errno) + ")");
    }
    return static_cast<size_t>(count);
  }

 private:
  const std::string _name;
  const int _file;
};

// Returns true if the format shows itself in the first characters of a capture, though more of it will come.
bool isHead(std::string_view text) {
  return trimmed(text).substr(0, 1) == "$" || text.size() >= CaptureHeadMax;
}

}  // namespace

CaptureEnd readCapture(const std::string &name, const Overrules &overrules, WireDecoder &decoder) {
  File file(name);
  CaptureEnd end;
  std::unique_ptr<CaptureReader> reader;
  std::vector<char> block(BlockSize);
  size_t filled = 0;
  bool more = true;
  bool cutOff = false;
  while (more && end.error.empty()) {
    const size_t count = file.read(block.data() + filled, block.size() - filled);
    filled += count;
    more = count > 0;
    std::string_view text(block.data(), filled);
    const bool full = filled == block.size();
    if (more && !full && (reader ? reader->wantsFullBlocks() : !isHead(text))) {
      continue;
    }
    if (!reader) {
      OpenedCapture opened = openCapture(text.substr(0, CaptureHeadMax), decoder, overrules);
      if (!opened.error.empty()) {
        throw std::runtime_error(name + ": " + opened.error);
      }
      reader = std::move(opened.reader);
    }
    if (more) {
      text = text.substr(0, text.rfind('\n') + 1);
      if (text.empty() && !full) {
        continue;
      }
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

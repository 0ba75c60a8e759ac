#include "line/capture/CaptureFile.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <stdexcept>

#include "line/capture/PackedFile.h"
#include "line/capture/SessionReader.h"
#include "line/capture/Text.h"

namespace line {

namespace {

constexpr size_t BlockSize = size_t{1} << 20;

constexpr size_t MetadataMax = size_t{1} << 20;

CaptureEnd readSession(const std::string &name, const Overrules &overrules, PackedFile &file, WireDecoder &decoder) {
  const auto reject = [&](const std::string &why) {
    throw std::runtime_error(name + ": " + (file.failure().empty() ? why : file.failure()));
  };
  if (!file.canGoBack()) {
    reject("is a pipe, and a session is read more than once: save it in a file first");
  }
  if (!file.find("metadata")) {
    reject("is a ZIP, but no session of sigrok or PulseView, which has metadata: export it as VCD or as CSV");
  }
  std::string metadata;
  for (std::string_view bytes = file.read(); !bytes.empty() && metadata.size() < MetadataMax; bytes = file.read()) {
    metadata += bytes;
  }
  SessionReader reader(decoder, overrules.periodNs);
  std::string error = reader.metadata(metadata);
  if (!error.empty() || overrules.threshold) {
    reject(error.empty() ? "has no voltages: leave out --threshold" : error);
  }
  // In one entry, or in several that are numbered.
  const std::string &entry = reader.samplesName();
  const bool isWhole = file.find(entry);
  unsigned entries = 0;
  while (error.empty() && (isWhole ? entries == 0 : file.find(entry + "-" + std::to_string(entries + 1)))) {
    entries++;
    for (std::string_view bytes = file.read(); !bytes.empty() && error.empty(); bytes = file.read()) {
      error = reader.put(bytes);
    }
    error = error.empty() ? file.failure() : error;
  }
  error = error.empty() ? file.failure() : error;
  if (entries == 0) {
    reject("has no samples: " + entry + " or " + entry + "-1 is expected in it");
  }
  decoder.finish(reader.endNs(), !error.empty());
  return {reader.format(), reader.periodNs(), error.empty() ? "" : name + ": " + error};
}

// Returns true if the format shows itself in the first characters of a capture, though more of it will come.
bool isHead(std::string_view text) {
  return trimmed(text).substr(0, 1) == "$" || text.size() >= CaptureHeadMax;
}

}  // namespace

CaptureEnd readCapture(const std::string &name, const Overrules &overrules, WireDecoder &decoder) {
  PackedFile file(name);
  if (file.isZip()) {
    return readSession(name, overrules, file, decoder);
  }
  CaptureEnd end;
  std::string_view fresh;
  std::unique_ptr<CaptureReader> reader;
  std::vector<char> block(BlockSize);
  size_t filled = 0;
  bool more = true;
  bool cutOff = false;
  while (more && end.error.empty()) {
    fresh = fresh.empty() ? file.read() : fresh;
    const size_t count = std::min(fresh.size(), block.size() - filled);
    std::copy_n(fresh.data(), count, block.data() + filled);
    fresh.remove_prefix(count);
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
        throw std::runtime_error(name + ": " + (file.failure().empty() ? opened.error : file.failure()));
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
  end.error = file.failure().empty() ? end.error : name + ": " + file.failure();
  decoder.finish(reader->endNs(), !end.error.empty());
  end.format = reader->format();
  end.periodNs = reader->periodNs();
  return end;
}

}  // namespace line

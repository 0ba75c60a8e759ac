#include "line/file/CaptureFile.h"

#include <stdexcept>

#include "line/capture/PackedFile.h"
#include "line/capture/SessionReader.h"
#include "line/file/FileHead.h"

namespace line {

namespace {

constexpr size_t MetadataMax = size_t{1} << 20;

CaptureEnd readSession(const std::string &name, const Overrides &overrides, PackedFile &file, WireDecoder &decoder) {
  const auto reject = [&](const std::string &why) {
    throw std::runtime_error(name + ": " + (file.failure().empty() ? why : file.failure()));
  };
  file.find("metadata");
  std::string metadata;
  for (std::string_view bytes = file.read(); !bytes.empty() && metadata.size() < MetadataMax; bytes = file.read()) {
    metadata += bytes;
  }
  SessionReader reader(decoder, overrides.periodNs);
  std::string error = reader.metadata(metadata);
  if (!error.empty() || overrides.threshold) {
    reject(error.empty() ? "has no voltages: leave out --threshold" : error);
  }
  // The samples are in one entry, or in several numbered ones.
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
    reject(reader.noSamples());
  }
  decoder.finish(reader.endNs(), !error.empty());
  return {reader.format(), reader.periodNs(), error.empty() ? "" : name + ": " + error, ""};
}

}  // namespace

CaptureEnd readCapture(const std::string &path, const std::string &name, const Overrides &overrides,
                       WireDecoder &decoder) {
  PackedFile file(path, name);
  if (file.isSession()) {
    return readSession(name, overrides, file, decoder);
  }
  file.findOnly();
  CaptureText text(name, overrides, decoder);
  TextFile plain(file);
  // A pipe brings a few bytes first.
  std::string begin(plain.read());
  while (!begin.empty() && begin.find('\n') == std::string::npos && begin.size() < FileHeadMax) {
    const std::string_view read = plain.read();
    if (read.empty()) {
      break;
    }
    begin += read;
  }
  const FileKind kind = kindOfText(begin);
  const std::string other = whyNoCapture(kind, begin);
  if (!other.empty() && kind != FileKind::Text) {  // a pipe's first line may look like bytes
    throw std::runtime_error(name + ": " + other);
  }
  bool goesOn = text.put(begin);
  for (std::string_view read = plain.read(); goesOn && !read.empty(); read = plain.read()) {
    goesOn = text.put(read);
  }
  CaptureEnd end = text.finish(file.failure());
  if (!end.rejection.empty()) {
    throw std::runtime_error(other.empty() ? end.rejection : name + ": " + other);
  }
  return end;
}

}  // namespace line

// Decodes captures of the wire, and makes the captures for the tests.
#pragma once

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "line/capture/SessionReader.h"
#include "line/capture/WireDecoder.h"
#include "support/Bytes.h"
#include "support/KnownFrames.h"
#include "support/WireText.h"

using line::WireCharacter;

// The result of decoding a text, which is passed in blocks of whole lines, like a file.
struct Decoded {
  std::vector<WireCharacter> characters;
  std::string error;  // the place and what is wrong
  std::string failure;
  std::string format;
  std::string signal;
  std::vector<std::string> others;
  line::FoundWire wire;

  explicit Decoded(const std::string &text, const std::string &only = "") : Decoded(text, signalOf(only)) {}

  Decoded(const std::string &text, const line::Overrides &overrides) {
    constexpr size_t blockMax = 5000;
    line::WireDecoder decoder(
        overrides, [] {}, [this](const WireCharacter &character) { characters.push_back(character); });
    line::OpenedCapture opened =
        line::openCapture(std::string_view(text).substr(0, line::CaptureHeadMax), decoder, overrides);
    error = opened.error;
    if (!opened.reader) {
      return;
    }
    for (size_t from = 0; from < text.size() && error.empty();) {
      const size_t end = text.size() - from <= blockMax ? text.size() : text.rfind('\n', from + blockMax) + 1;
      error = opened.reader->put(std::string_view(text).substr(from, end - from));
      from = end;
    }
    error = error.empty() ? opened.reader->finish() : error;
    format = opened.reader->format();
    error = error.empty() ? "" : std::to_string(opened.reader->lines()) + ": " + error;
    decoder.finish(opened.reader->endNs(), !error.empty());
    if (decoder.found()) {
      signal = decoder.signal();
      others = decoder.others();
      wire = decoder.wire();
    } else {
      failure = decoder.failure(opened.reader->periodNs());
    }
  }

  // Decodes an unpacked session, with its samples in pieces.
  Decoded(const std::string &metadata, const std::string &samples, size_t piece) {
    line::WireDecoder decoder(
        {}, [] {}, [this](const WireCharacter &character) { characters.push_back(character); });
    line::SessionReader reader(decoder, 0);
    error = reader.metadata(metadata);
    for (size_t from = 0; from < samples.size() && error.empty(); from += piece) {
      error = reader.put(std::string_view(samples).substr(from, piece));
    }
    decoder.finish(reader.endNs(), !error.empty());
    signal = decoder.found() ? decoder.signal() : "";
  }

  static line::Overrides signalOf(const std::string &name) {
    line::Overrides overrides;
    overrides.signal = name;
    return overrides;
  }

  Bytes bytes() const {
    Bytes all;
    for (const WireCharacter &character : characters) {
      CHECK_FALSE(character.bad());
      all.push_back(character.value);
    }
    return all;
  }
};

inline const Bytes All = join({PaperLow.bytes, PaperHigh.bytes, Neutral.bytes, Sbus2.bytes});

inline TestWire wireOf(double bitNs = 10000, bool inverted = true) {
  TestWire wire;
  wire.bitNs = bitNs;
  wire.inverted = inverted;
  for (const KnownFrame &frame : KnownFrames) {
    wire.bytes(frame.bytes);
    wire.gap(4000000);
  }
  return wire;
}

// Returns the wire as a logic analyser samples it.
inline std::string sampled(const TestWire &wire, double periodNs) {
  std::string text = printed("; Samplerate: %.6f Hz\nlogic\n", 1e9 / periodNs);
  size_t edge = 0;
  for (double ns = 0; ns < wire.ns; ns += periodNs) {
    for (; edge < wire.edges.size() && wire.edges[edge] <= ns; edge++) {
    }
    text += edge % 2 == 0 ? "0\n" : "1\n";
  }
  return text;
}

// Returns the text with `now` in place of each `before`.
inline std::string replaced(std::string text, const std::string &before, const std::string &now) {
  for (size_t at = text.find(before); at != std::string::npos; at = text.find(before, at + now.size())) {
    text.replace(at, before.size(), now);
  }
  return text;
}

inline bool holds(const std::string &text, const std::string &part) { return text.find(part) != std::string::npos; }

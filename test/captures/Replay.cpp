// Replays recordings of real receivers through DecodeSBus32 on the board's driver, and says "ok ..." or "FAILED ...".
// Those of 24 channels go through DecodeSBus24.
//
//   Replay FOLDER
//
// For the files below, what a right decoder finds is known; for any other file, this prints the counts, and checks that
// every delivered frame is in the recording.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "support/UartPort.h"
#include "line/recording/RecordingReader.h"

#include <DecodeSBus32.h>

namespace {

using EndBytes = std::map<int, unsigned>;  // end byte -> how many frames

struct Expected {
  EndBytes ends;
  std::vector<uint16_t> channels;  // of every frame; flags are 0
};

// Returns the channels of a frame of either size, bit by bit (support/BitByBit.h).
template <typename Format>
std::vector<uint16_t> channelsOf(const uint8_t *frame) {
  std::vector<uint16_t> channels(Format::Channels);
  for (size_t bit = 0; bit < (Format::Size - 3) * 8u; bit++) {
    const unsigned value = (frame[1 + bit / 8] >> bit % 8 & 1) != 0 ? 1u << bit % 11 : 0u;
    channels[bit / 11] = static_cast<uint16_t>(channels[bit / 11] | value);
  }
  if (Format::Channels == sbus::ChannelCount) {
    channels[16] = frame[23] & 1;
    channels[17] = frame[23] >> 1 & 1;
  }
  return channels;
}

const std::map<std::string, Expected> Known = {
    {"r7008sb-sbus2.txt",
     {{{0x14, 21}, {0x34, 21}, {0x24, 20}, {0x04, 20}},
      {1041, 1024, 1696, 1024, 352, 1696, 1024, 1024, 1024, 1024, 1024, 1024, 1024, 1024, 1024, 1024, 0, 0}}},
    {"frsky-neutral.txt",
     {{{0x00, 1}}, {997, 992, 992, 992, 992, 992, 992, 992, 992, 192, 992, 192, 985, 992, 992, 992, 0, 0}}},
};

// Returns the end byte of the first frame in `characters` from `from` on with these bytes, or -1; `from` is then after
// it.
template <typename Format>
int endOf(const line::Characters &characters, size_t &from, const std::vector<uint16_t> &channels, bool failsafe,
          bool lostFrame) {
  const unsigned flags = (failsafe ? 8 : 0) | (lostFrame ? 4 : 0);
  for (size_t at = from; at + Format::Size <= characters.size(); at++) {
    uint8_t frame[Format::Size];
    for (size_t i = 0; i < Format::Size; i++) {
      frame[i] = characters[at + i].value;
    }
    const uint8_t end = frame[Format::Size - 1];
    if (frame[0] == 0x0F && (frame[Format::Size - 2] & 0xFC) == flags && sbus::isEndByte(end) &&
        channelsOf<Format>(frame) == channels) {
      from = at + Format::Size;
      return end;
    }
  }
  return -1;
}

// Returns what is wrong, or nothing.
template <typename Decoder, typename Format>
std::string replay(const line::Characters &characters, uint32_t loopUs, const Expected *expected) {
  const uint64_t start = fakeMicros + 1000;
  UartPort port;
  Decoder dSBus(port);
  dSBus.begin();
  std::string wrong;
  EndBytes ends;
  size_t from = 0;
  size_t next = 0;
  for (uint64_t after = 0; after < 20000; after += next == characters.size() ? loopUs : 0) {
    fakeMicros += loopUs;
    for (; next < characters.size() && start + characters[next].endUs <= fakeMicros; next++) {
      line::Character character = characters[next];
      character.endUs += start;
      port.receive(character);
    }
    port.advance(fakeMicros);
    dSBus.parseSBusFrame();
    if (dSBus.newFrame()) {
      std::vector<uint16_t> channels(Format::Channels);
      bool failsafe, lostFrame;
      dSBus.decodeSBusFrame(channels.data(), failsafe, lostFrame);
      const int end = endOf<Format>(characters, from, channels, failsafe, lostFrame);
      ends[end]++;
      if (end < 0) {
        wrong = "a frame that is not in the recording, or not there, was delivered";
      } else if (expected != nullptr && (channels != expected->channels || failsafe || lostFrame)) {
        wrong = "a frame with other values than known was delivered";
      }
    }
  }
  const sbus::Counters counters = dSBus.counters();
  if (Format::Size == sbus::FrameSize && counters.frames == 0 && counters.otherSizeFrames != 0) {
    return replay<DecodeSBus24, sbus::Frame24>(characters, loopUs, expected);
  }
  std::printf(
      "%u frames of %u channels, %u with header 2F, rejected by end %u, by flags %u, by extra %u, bytes discarded %u, "
      "resynchronised %u, T = %u us\n",
      counters.frames, Format::Channels, counters.extraFrames, counters.rejectedByEnd, counters.rejectedByFlags,
      counters.rejectedByLength, counters.discardedBytes, counters.resyncs, counters.period);
  if (wrong.empty() && expected != nullptr && ends != expected->ends) {
    wrong = "end bytes are not what is known:";
    for (const auto &end : ends) {
      wrong += " " + std::to_string(end.first) + " x" + std::to_string(end.second);
    }
  }
  return wrong;
}

}  // namespace

int main(int argc, char **argv) {
  const std::string folder = argc == 2 ? argv[1] : "";
  std::error_code missing;
  std::set<std::filesystem::path> files;
  for (const auto &entry : std::filesystem::directory_iterator(folder, missing)) {
    if (entry.path().extension() == ".txt") {
      files.insert(entry.path());
    }
  }
  bool failed = files.empty();
  if (failed) {
    std::printf("FAILED captures: there is no *.txt in the folder \"%s\"\n", folder.c_str());
  }
  for (const std::filesystem::path &file : files) {
    const std::string name = file.filename().string();
    std::ifstream in(file);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    const line::Recording recording = line::parseRecording(text);
    if (!recording.error.empty()) {
      std::printf("FAILED captures/%s:%u: %s\n", name.c_str(), recording.errorLine, recording.error.c_str());
      failed = true;
      continue;
    }
    const auto known = Known.find(name);
    for (const uint32_t loopUs : {50u, 3000u}) {
      std::printf("%s, loop() of %u us: ", name.c_str(), loopUs);
      const std::string wrong = replay<DecodeSBus32, sbus::Frame16Extra>(
          recording.characters, loopUs, known == Known.end() ? nullptr : &known->second);
      std::printf("%s captures/%s, loop() of %u us%s%s\n", wrong.empty() ? "ok" : "FAILED", name.c_str(), loopUs,
                  wrong.empty() ? (known == Known.end() ? ", of which nothing is known" : "") : ": ", wrong.c_str());
      failed = failed || !wrong.empty();
    }
  }
  return failed;
}

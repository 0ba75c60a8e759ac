// What the page must know to read structs and numbers out of the memory, a line each:
//
//   field Record channels 8 double 32    its offset, type and count
//   size Record 392                      bytes
//   value LinkState Stale 4
//   constant Enough 256
#include <cstddef>
#include <string>

#include "Scope.h"
#include "Status.h"
#include "line/capture/Capture.h"
#include "sbus/Calibrator.h"

using namespace scope;

namespace {

std::string lines;

void add(const char *what, const char *of, const std::string &rest) {
  lines += std::string(what) + " " + of + " " + rest + "\n";
}

constexpr const char *typeOf(const double &) {
  return "double";
}
constexpr const char *typeOf(const uint8_t &) {
  return "byte";
}
constexpr const char *typeOf(const char &) {
  return "letter";
}

template <typename T>
std::string madeOf(const T &value) {
  return std::string(typeOf(value)) + " 1";
}
template <typename T, size_t Count>
std::string madeOf(const T (&values)[Count]) {
  return std::string(typeOf(values[0])) + " " + std::to_string(Count);
}

#define FIELD(Struct, name) \
  add("field", #Struct, #name " " + std::to_string(offsetof(Struct, name)) + " " + madeOf(Struct{}.name));
#define STATUS_FIELD(name) FIELD(Status, name)

// No switch has a default: the compiler rejects one that lacks an enumerator.
#define VALUE(name) \
  case T::name:     \
    return #name;

const char *nameOf(sbus::LinkState value) {
  using T = sbus::LinkState;
  switch (value) { VALUE(NeverSeen) VALUE(Ok) VALUE(Lossy) VALUE(Failsafe) VALUE(Stale) }
  return nullptr;
}

const char *nameOf(sbus::Finding value) {
  using T = sbus::Finding;
  switch (value) {
    VALUE(NoSignal)
    VALUE(NoFrames) VALUE(Channels24) VALUE(WrongPolarity) VALUE(WrongBaud) VALUE(WrongPolarityAndBaud)
        VALUE(PolledTooSeldom) VALUE(InterruptsOff) VALUE(Noise) VALUE(Failsafe) VALUE(NoRadio) VALUE(Lossy)
            VALUE(AllWellAndMore) VALUE(AllWell)
  }
  return nullptr;
}

const char *nameOf(sbus::CalibrationError value) {
  using T = sbus::CalibrationError;
  switch (value) {
    VALUE(None)
    VALUE(NeverSeen) VALUE(HardlyMoved) VALUE(CentreOutside) VALUE(NotStill) VALUE(NotCentred) VALUE(NotPushed)
        VALUE(MovedOneWay) VALUE(NotRested) VALUE(NotHeld)
  }
  return nullptr;
}

const char *nameOf(line::Stretch::Kind value) {
  using T = line::Stretch::Kind;
  switch (value) { VALUE(Frame) VALUE(Frame24) VALUE(Extra) VALUE(NoFrame) }
  return nullptr;
}

const char *nameOf(Scale value) {
  using T = Scale;
  switch (value) { VALUE(FrSky) VALUE(Futaba) VALUE(Calibrated) }
  return nullptr;
}

// Each begins at 0 and has no holes. Returns the first number that is free.
template <typename T>
int addValues(const char *of) {
  int value = 0;
  for (; nameOf(static_cast<T>(value)) != nullptr; value++) {
    add("value", of, std::string(nameOf(static_cast<T>(value))) + " " + std::to_string(value));
  }
  return value;
}

void addFlag(const char *name, int value) {
  add("value", "Flag", std::string(name) + " " + std::to_string(value));
}

}  // namespace

EXPORT(layout)()->const char * {
  if (!lines.empty()) {
    return lines.c_str();
  }
  FIELD(Record, endUs)
  FIELD(Record, lateUs)
  FIELD(Record, damagedUs)
  FIELD(Record, channels)
  FIELD(Record, kind)
  FIELD(Record, flags)
  FIELD(Record, channelCount)
  FIELD(Record, size)
  FIELD(Record, slots)
  FIELD(Record, state)
  FIELD(Record, bytes)
  FIELD(Record, why)
  add("size", "Record", std::to_string(sizeof(Record)));
  SCOPE_STATUS(STATUS_FIELD)
  addValues<sbus::LinkState>("LinkState");
  addValues<sbus::Finding>("Finding");
  addValues<sbus::CalibrationError>("CalibrationError");
  addValues<Scale>("Scale");
  add("value", "Kind", "Row " + std::to_string(addValues<line::Stretch::Kind>("Kind")));
  add("value", "Kind", "Silence " + std::to_string(Record::SilenceKind));
  static_assert(Record::RowKind == static_cast<int>(line::Stretch::Kind::NoFrame) + 1, "the page's Kind has no hole");
  addFlag("Channel17", sbus::FlagChannel17);
  addFlag("Channel18", sbus::FlagChannel18);
  addFlag("LostFrame", sbus::FlagLostFrame);
  addFlag("Failsafe", sbus::FlagFailsafe);
  addFlag("ByLosses", FlagByLosses);
  addFlag("Event", FlagEvent);
  addFlag("HasFlags", FlagHasFlags);
  addFlag("HasSwitches", FlagHasSwitches);
  add("constant", "Enough", std::to_string(Scope::Enough));
  add("constant", "TransferSize", std::to_string(TransferSize));
  add("constant", "CharacterSize", std::to_string(sizeof(line::Character)));
  add("constant", "HeadSize", std::to_string(line::CaptureHeadMax));
  static_assert(line::CaptureHeadMax <= TransferSize, "it is handed over at once");
  return lines.c_str();
}

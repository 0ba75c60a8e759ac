/// @file
/// Decodes a line, and finds what is wrong with it.
#pragma once

#include "DecodeSBus.h"
#include "sbus/Symptoms.h"

/// Decodes like a DecodeSBus32, but without CH17..CH32, and collects what sbus::Diagnosis needs. The example Diagnose
/// tries each setting of the port with it.
template <typename Polling>
class DecodeSBusDiagnosisOf : public DecodeSBusOf<sbus::Frame16Extra, sbus::Symptoms, Polling> {
  using Decoder = DecodeSBusOf<sbus::Frame16Extra, sbus::Symptoms, Polling>;

 public:
  template <typename Other>
  using PolledBy = DecodeSBusDiagnosisOf<Other>;  ///< see DecodeSBusOf
  using Decoder::Decoder;                         ///< see DecodeSBusOf()

  /// Returns what has come since begin() with this setting, `ms` milliseconds ago: for sbus::Diagnosis::add().
  sbus::Trial trial(unsigned long baud, bool inverted, uint32_t ms) const {
    const typename Decoder::Lock lock(*this);
    const sbus::Symptoms &symptoms = this->_finder.events();
    return {baud, inverted, ms, this->_finder.counters(), symptoms.pulseless(), symptoms.found()};
  }
};

/// Decodes sixteen channels and two switches, and finds what is wrong with the line.
using DecodeSBusDiagnosis = DecodeSBusDiagnosisOf<sbus::PolledByLoop>;

#include "cli/Stop.h"

#include <csignal>

#include "line/system/System.h"

namespace tool {

namespace {

volatile std::sig_atomic_t stopRequested = 0;

void requestStop(int signal) {
  stopRequested = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void catchSignals() { line::onStop(requestStop); }

bool stopped() { return stopRequested != 0; }

void forgetStop() { stopRequested = 0; }

}  // namespace tool

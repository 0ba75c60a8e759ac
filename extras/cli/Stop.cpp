#include "cli/Stop.h"

#include <csignal>
#include <initializer_list>

namespace tool {

namespace {

volatile std::sig_atomic_t stopRequested = 0;

void requestStop(int signal) {
  stopRequested = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void catchSignals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    std::signal(signal, requestStop);
  }
  std::signal(SIGPIPE, SIG_IGN);
}

bool stopped() {
  return stopRequested != 0;
}

void forgetStop() {
  stopRequested = 0;
}

}  // namespace tool

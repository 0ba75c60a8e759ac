#include "Receivers.h"

void parse(Ours &ours) {
  ours.receiver.parseSBusFrame();
}
void parse(Papers &papers) {
  papers.receiver.parseSBusFrame();
}

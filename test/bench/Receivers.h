// Ours and the paper's, each in a function of its own: so neither is compiled together with the port.
#pragma once

#include <DecodeSBus.h>

#include "MemorySerial.h"
#include "support/PaperDecoder.h"

struct Ours {
  MemorySerial port;
  DecodeSBus receiver{port};
};
struct Papers {
  MemorySerial port;
  PaperDecoder receiver{port};
};

void parse(Ours &ours);
void parse(Papers &papers);

#include "Attack.h"

#include <cstdio>

std::string textOf(const Attack &attack) {
  std::string text;
  auto next = attack.bytes.begin();
  for (const Attack::Call &call : attack.calls) {
    text += "+" + std::to_string(call.gapUs());
    for (size_t i = 0; i < call.size; i++) {
      char hex[4];
      std::snprintf(hex, sizeof hex, " %02X", *next++);
      text += hex;
    }
    text += "\n";
  }
  return text;
}

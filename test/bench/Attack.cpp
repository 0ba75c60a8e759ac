#include "Attack.h"

#include <cstdio>
#include <cstdlib>

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

Attack attackOf(const char *text) {
  Attack attack;
  while (*text == '+') {
    char *at;
    const auto gapUs = static_cast<uint32_t>(std::strtoul(text + 1, &at, 10));
    Bytes bytes;
    while (*at == ' ') {
      bytes.push_back(static_cast<uint8_t>(std::strtoul(at, &at, 16)));
    }
    attack.add(bytes, gapUs - static_cast<uint32_t>(bytes.size()) * line::CharacterUs);
    text = at + 1;  // behind the end of the line
  }
  return attack;
}

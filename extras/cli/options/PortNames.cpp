#include "cli/options/PortNames.h"

#include <libserialport.h>

namespace tool {

std::vector<std::string> portNames() {
  std::vector<std::string> names;
  sp_port **ports = nullptr;
  if (sp_list_ports(&ports) == SP_OK) {
    for (size_t i = 0; ports[i] != nullptr; i++) {
      names.push_back(sp_get_port_name(ports[i]));
    }
    sp_free_port_list(ports);
  }
  return names;
}

}  // namespace tool

// sbus ports: lists the serial ports of this PC, and what is known about each.

#include <libserialport.h>

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <memory>
#include <optional>
#include <stdexcept>

#include "cli/Json.h"
#include "cli/Output.h"
#include "cli/options/Subcommand.h"
#include "cli/subcommands/Subcommands.h"
#include "line/Format.h"
#include "line/ports/LowLatency.h"
#include "line/system/System.h"

namespace tool {

namespace {

constexpr int AnyProduct = -1;

// Sources: boards.txt of ArduinoCore-stm32l0; extras/docs/ftdi.md for adapters that can invert.
struct KnownPort {
  int vendor;
  int product;
  const char *what;
};
constexpr KnownPort KnownPorts[] = {
    {0x0403, AnyProduct, "FTDI adapter: S.Bus, once its RXD is inverted (extras/docs/ftdi.md)"},
    {0x1209, 0x6665, "Grasshopper: its sketch's output, rows of CSV"},
    {0x1209, 0x6664, "Cricket: its sketch's output, rows of CSV"},
    {0x1209, 0x6663, "Cicada: its sketch's output, rows of CSV"},
    {0x1209, 0x6662, "Gnat: its sketch's output, rows of CSV"},
    {0x2341, AnyProduct, "Arduino: its sketch's output; read it with --rows"},
    {0x1A86, AnyProduct, "CH340 or similar: no setting inverts it; put an inverter in front of RXD"},
    {0x10C4, 0xEA60, "CP210x: no setting inverts it; put an inverter in front of RXD"},
};

std::string textOf(const char *text) { return text != nullptr ? text : ""; }

// What the system tells about a port.
struct Port {
  explicit Port(sp_port *port) : device(sp_get_port_name(port)), description(textOf(sp_get_port_description(port))) {
    isUsb =
        sp_get_port_transport(port) == SP_TRANSPORT_USB && sp_get_port_usb_vid_pid(port, &vendor, &product) == SP_OK;
    serial = isUsb ? textOf(sp_get_port_usb_serial(port)) : "";
  }

  const char *known() const {
    const auto *const found = std::find_if(std::begin(KnownPorts), std::end(KnownPorts), [this](const KnownPort &each) {
      return isUsb && each.vendor == vendor && (each.product == product || each.product == AnyProduct);
    });
    return found == std::end(KnownPorts) ? "" : found->what;
  }

  std::string device;
  std::string description;
  bool isUsb = false;
  int vendor = 0;
  int product = 0;
  std::string serial;
};

Json json(const Port &port) {
  Json json("port");
  json.text("name", port.device).text("description", port.description);
  if (port.isUsb) {
    json.text("usb_vendor", line::format("%04x", static_cast<unsigned>(port.vendor)))
        .text("usb_product", line::format("%04x", static_cast<unsigned>(port.product)))
        .text("serial_number", port.serial)
        .text("known_as", port.known());
  }
  const std::optional<unsigned> ms = line::latencyMs(line::latencyFile(port.device));
  if (ms) {
    json.number("latency_ms", *ms);
  }
  return json.flag("permission", line::mayOpen(port.device));
}

// Returns advice for a port that holds bytes back. Ports that sbus opens itself are set to 1 ms.
std::string latencyText(const std::string &device) {
  const std::string file = line::latencyFile(device);
  const std::optional<unsigned> ms = line::latencyMs(file);
  return !ms || *ms <= 1 ? "" : "holds bytes back for up to " + std::to_string(*ms) + " ms: echo 1 | sudo tee " + file;
}

void addLine(std::string &text, const std::string &line) { text += line.empty() ? "" : "    " + line + "\n"; }

std::string describe(const Port &port) {
  const bool isName = port.device.find(port.description) != std::string::npos;
  std::string text = port.device + (isName ? "" : "  " + port.description) + "\n";
  if (port.isUsb) {
    const std::string serial = port.serial.empty() ? "" : ", serial number " + port.serial;
    addLine(text, line::format("USB %04x:%04x%s", static_cast<unsigned>(port.vendor),
                               static_cast<unsigned>(port.product), serial.c_str()));
  }
  addLine(text, port.known());
  addLine(text, latencyText(port.device));
  addLine(text, line::mayOpen(port.device) ? "" : "no permission: sbus doctor " + port.device + " says what to do");
  return text;
}

void run(bool asJson) {
  sp_port **ports = nullptr;
  if (sp_list_ports(&ports) != SP_OK) {
    throw std::runtime_error(std::string("the system does not list its ports; look in ") + line::PortsPlace);
  }
  const std::unique_ptr<sp_port *, decltype(&sp_free_port_list)> owner(ports, sp_free_port_list);
  if (ports[0] == nullptr) {
    std::fprintf(stderr, "no serial port; plug the adapter in\n");
  }
  for (size_t i = 0; ports[i] != nullptr; i++) {
    write(asJson ? json(Port(ports[i])).line() : describe(Port(ports[i])));
  }
  flush();
}

}  // namespace

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

void addPorts(CLI::App &app) {
  Subcommand subcommand(app, "ports", "lists the serial ports, and what is known about each");
  const auto asJson = std::make_shared<bool>(false);
  subcommand.flag("--json", *asJson, "JSON lines, one per port");
  subcommand.run([asJson] { run(*asJson); });
}

}  // namespace tool

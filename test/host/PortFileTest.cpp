// What opening a port leaves behind.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <iterator>

#include "line/ports/PortFile.h"
#include "line/ports/PseudoTerminal.h"
#include "line/ports/Reopened.h"

// libserialport 0.1.2, serialport.c: sp_free_port() frees memory and leaves the file open; only sp_close() closes it,
// and returns an error for a port that is not open.
struct sp_port {
  std::string name;
  int file = -1;
};
struct sp_port_config {
  int baud = 0;
};

namespace {

int baudSet = 0;

size_t openFiles() {
  const std::filesystem::directory_iterator files("/proc/self/fd");
  return static_cast<size_t>(std::distance(begin(files), end(files)));
}

}  // namespace

sp_return sp_get_port_by_name(const char *name, sp_port **port) {
  *port = new sp_port{name, -1};
  return SP_OK;
}
void sp_free_port(sp_port *port) { delete port; }
sp_return sp_open(sp_port *port, sp_mode) {
  port->file = open(port->name.c_str(), O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  return port->file >= 0 ? SP_OK : SP_ERR_FAIL;
}
sp_return sp_close(sp_port *port) {
  const bool wasOpen = port->file >= 0 && close(port->file) == 0;
  port->file = -1;
  return wasOpen ? SP_OK : SP_ERR_ARG;
}
sp_return sp_get_port_handle(const sp_port *port, void *handle) {
  *static_cast<int *>(handle) = port->file;
  return SP_OK;
}
sp_return sp_set_baudrate(sp_port *, int baud) {
  baudSet = baud;
  return SP_OK;
}
sp_return sp_set_bits(sp_port *, int) { return SP_OK; }
sp_return sp_set_parity(sp_port *, sp_parity) { return SP_OK; }
sp_return sp_set_stopbits(sp_port *, int) { return SP_OK; }
sp_return sp_set_flowcontrol(sp_port *, sp_flowcontrol) { return SP_OK; }
sp_return sp_new_config(sp_port_config **config) {
  *config = new sp_port_config;
  return SP_OK;
}
void sp_free_config(sp_port_config *config) { delete config; }
sp_return sp_get_config(sp_port *, sp_port_config *config) {
  config->baud = baudSet == 200000 ? 230400 : baudSet;  // an adapter that takes any rate and has few
  return SP_OK;
}
sp_return sp_get_config_baudrate(const sp_port_config *config, int *baud) {
  *baud = config->baud;
  return SP_OK;
}
sp_return sp_output_waiting(sp_port *port) { return port->name == "/dev/full" ? SP_OK : SP_ERR_FAIL; }
sp_return sp_flush(sp_port *, sp_buffer) { return SP_OK; }
int sp_last_error_code() { return errno; }
char *sp_last_error_message() { return nullptr; }
void sp_free_error_message(char *) {}

TEST_CASE("a port that goes and comes back a hundred times leaves no file open") {
  const size_t before = openFiles();
  {
    line::SendingPort port("/dev/full", {});  // each write fails, as on a port whose adapter is unplugged
    const uint8_t byte = 0x0F;
    for (uint64_t second = 1; second <= 100; second++) {
      port.write(second * 1000000, &byte, 1);
      CHECK(port.news().find("is gone") != std::string::npos);
    }
  }
  CHECK(openFiles() == before);
}

TEST_CASE("a port that cannot run at the rate, or cannot be opened, leaves no file open") {
  const size_t before = openFiles();
  line::LineSettings fast;
  fast.baud = 200000;
  CHECK_THROWS_WITH(line::PortFile("/dev/null", fast, line::PortFile::Way::Write),
                    doctest::Contains("this adapter cannot do 200000 baud"));
  CHECK_THROWS_WITH(line::PortFile("/dev/none", {}, line::PortFile::Way::Write), doctest::Contains("no such port"));
  CHECK(openFiles() == before);
}

TEST_CASE("a pseudo-terminal holds bytes until its reader reads, and says so") {
  line::PseudoTerminal terminal;
  line::PortFile port(terminal.name(), {}, line::PortFile::Way::Write);
  CHECK(port.mayMissReads());
  CHECK(!port.holdsBytes());
  const uint8_t frame[25] = {0x0F};
  for (int i = 0; i < 3; i++) {
    CHECK(port.write(frame, sizeof frame) == 25);
    CHECK(port.holdsBytes());
    CHECK(port.holdsBytes());
    uint8_t read[100];
    size_t count = 0;
    while (count < sizeof frame) {
      count += terminal.read(read, sizeof read);
    }
    CHECK(!port.holdsBytes());
  }
}

// Standard output, for what comes line by line.
#pragma once

#include <functional>
#include <string>

namespace tool {

// True if it is a terminal.
bool isTerminal();

// Every line is seen at once, not when a buffer is full. Before the first write().
void setLineByLine();

// Throws std::runtime_error if it is full or has gone. A pipe's reader that has seen enough ends the program silently.
void write(const std::string &text);
void flush();

// `print` is given what takes its text: write(), or that of the file `name` if this is not empty. Throws
// std::runtime_error if it cannot be written.
using Put = std::function<void(const std::string &text)>;
void writeTo(const std::string &name, const std::function<void(const Put &put)> &print);

}  // namespace tool

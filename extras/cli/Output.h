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

// Takes a piece of text. Throws std::runtime_error if it cannot be written.
using Put = std::function<void(const std::string &text)>;

// Calls `print` with what writes to the file `name`; to standard output if that is empty or "-". A new one must not be
// there yet. Throws std::runtime_error.
enum class File { Any, New };
void writeTo(const std::string &name, File kind, const std::function<void(const Put &put)> &print);

}  // namespace tool

// Standard output, for what comes line by line.
#pragma once

#include <functional>
#include <string>

namespace tool {

// Returns true if standard output is a terminal.
bool isTerminal();

// Makes each line visible at once, not when a buffer is full. Call it before the first write().
void setLineByLine();

// Writes to standard output. Throws std::runtime_error if it is full or closed. If a pipe has lost its reader, the
// program ends silently.
void write(const std::string &text);
void flush();

// Writes a piece of text. Throws std::runtime_error if it cannot be written.
using Put = std::function<void(const std::string &text)>;

// Calls `print` with what writes to the file `name`; to standard output if the name is empty or "-". File::New: the
// file must not exist yet. Throws std::runtime_error.
enum class File { Any, New };
void writeTo(const std::string &name, File kind, const std::function<void(const Put &put)> &print);

// Throws std::runtime_error if the output is also the input.
void rejectSameFile(const std::string &read, const std::string &written);

}  // namespace tool

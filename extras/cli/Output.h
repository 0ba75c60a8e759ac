// Standard output, written line by line.
#pragma once

#include <functional>
#include <string>

namespace tool {

// Returns true if standard output is a terminal.
bool isTerminal();

// Flushes every line, instead of full buffers. Call it before the first write().
void setLineByLine();

// Writes to standard output. Throws std::runtime_error if it is full or closed. If the reader of a pipe is gone, ends
// the program silently.
void write(const std::string &text);
void flush();

// Writes a piece of text. Throws std::runtime_error if it cannot be written.
using Put = std::function<void(const std::string &text)>;

// Calls `print` with a function that writes to the file `name`, or to standard output if `name` is empty or "-".
// File::New: the file must not exist yet. Throws std::runtime_error; then a new
// file without a line is removed.
enum class File { Any, New };
void writeTo(const std::string &name, File kind, const std::function<void(const Put &put)> &print);

// Throws std::runtime_error if the output is also the input.
void rejectSameFile(const std::string &read, const std::string &written);

}  // namespace tool

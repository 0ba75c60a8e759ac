// Tells whether bytes that were written to a pseudo-terminal wait for the program at its other end.
#pragma once

namespace line {

// Linux does not count these bytes: TIOCOUTQ is 0, up to 20 KB may wait, and FIONREAD counts them only at the end where
// they are read. But it wakes the writer at each read that leaves 128 bytes or fewer (n_tty_check_unthrottle() of
// drivers/tty/n_tty.c). A write wakes it as well, so a read that follows within some microseconds is missed: up to half
// of them on a busy PC, where the reader interrupts the writer.
class Unread {
 public:
  // `file`: either end, which the caller closes.
  explicit Unread(int file);
  ~Unread();
  Unread(const Unread &) = delete;
  Unread &operator=(const Unread &) = delete;

  // Call it right after each write.
  void wrote();

  // Returns false if nothing was written, or the other program has read since the last write.
  bool waits();

 private:
  const int _file;
  const int _poll;
  bool _waits = false;
};

}  // namespace line

# For the scripts of this folder, to be sourced in test. SBUS: the program; WORK: an absolute folder, in which each script has
# one for what it writes, `work`, empty at first.

work=$WORK/$(basename "$0" .sh)
rm -rf "$work"
mkdir -p "$work"
export PYTHONPATH="$PWD/tool" PYTHONDONTWRITEBYTECODE=1

verdict() {  # STATUS WHAT
  if [ "$1" -eq 0 ]; then echo "ok sbus: $2"; else echo "FAILED sbus: $2"; fi
}

# Prints the bytes of a recording, one a line, without the marks of errors.
bytes() { grep -v '^#' "$1" | tr -d '\r' | cut -d' ' -f2- | tr -d '!' | tr ' ' '\n' | grep .; }

# player SUBCOMMAND ARGUMENTS...: starts sbus on a pseudo-terminal; sets `player` to its process, `terminal` to the name.
# Without a reader it would wait for ever.
player() {
  rm -f "$work/terminal"
  timeout --foreground 300 "$SBUS" "$@" >"$work/terminal" 2>"$work/player.err" &
  player=$!
  until_true has_terminal
}
# Sets `lasting` to a recording of the source: `send` waits for a reader without a limit, and then sends for SECONDS.
record_for() {  # SECONDS SOURCE
  lasting=$work/lasting.txt
  rm -f "$lasting"
  "$SBUS" record "$2" -o "$lasting" --simulated-time --seconds "$1" 2>"$work/lasting.err"
}
has_terminal() { read -r terminal <"$work/terminal"; } 2>/dev/null  # a whole line

# has_lines COUNT FILE: it has as many, or more
has_lines() { [ -f "$2" ] && [ "$(wc -l <"$2")" -ge "$1" ]; }

# until_true COMMAND...: waits until it succeeds, a minute at most
until_true() {
  tries=0
  until "$@"; do
    tries=$((tries + 1))
    [ $tries -lt 600 ] || return 1
    sleep 0.1
  done
}

# on_terminal COLUMNS COMMAND...: what it prints on a terminal of so many columns
on_terminal() {
  python3 - "$@" <<'END'
import fcntl, os, pty, struct, subprocess, sys, termios
master, slave = pty.openpty()
fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("HHHH", 24, int(sys.argv[1]), 0, 0))
program = subprocess.Popen(sys.argv[2:], stdout=slave)
os.close(slave)
try:
    while part := os.read(master, 4096):
        sys.stdout.buffer.write(part.replace(b"\r", b""))
except OSError:  # the end
    pass
END
}

# peak ARGUMENTS...: prints the kilobytes that sbus needed. A sanitizer would keep what is freed.
peak() {
  python3 -c 'import os, resource, subprocess, sys
subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL, check=True, env=dict(os.environ, ASAN_OPTIONS="quarantine_size_mb=1"))
print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)' "$SBUS" "$@"
}

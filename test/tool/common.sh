# Functions for the scripts of this folder: each says "ok sbus: ..." or "FAILED sbus: ...". To be sourced in test.

verdict() {  # STATUS WHAT
  if [ "$1" -eq 0 ]; then echo "ok sbus: $2"; else echo "FAILED sbus: $2"; fi
}

# Prints the bytes of a recording, one a line, without the marks of errors.
bytes() { grep -v '^#' "$1" | tr -d '\r' | cut -d' ' -f2- | tr -d '!' | tr ' ' '\n' | grep .; }

# player SUBCOMMAND ARGUMENTS...: starts sbus on a pseudo-terminal; sets `player` to its process, `terminal` to the name.
# Without a reader it would wait for ever.
# SBUS: the program; WORK: a folder.
player() {
  rm -f "$WORK/terminal"
  timeout --foreground 300 "$SBUS" "$@" >"$WORK/terminal" 2>"$WORK/player.err" &
  player=$!
  tries=0
  until { read -r terminal <"$WORK/terminal"; } 2>/dev/null || [ $tries -ge 600 ]; do  # a whole line
    sleep 0.1
    tries=$((tries + 1))
  done
}

# until_true COMMAND...: waits until it succeeds, a minute at most
until_true() {
  tries=0
  until "$@"; do
    tries=$((tries + 1))
    [ $tries -lt 600 ] || return 1
    sleep 0.1
  done
}

# peak ARGUMENTS...: prints the kilobytes that sbus needed. A sanitizer would keep what is freed.
peak() {
  python3 -c 'import os, resource, subprocess, sys
subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL, check=True, env=dict(os.environ, ASAN_OPTIONS="quarantine_size_mb=1"))
print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)' "$SBUS" "$@"
}

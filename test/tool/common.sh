# What the scripts of this folder share: each says "ok sbus: ..." or "FAILED sbus: ...". To be sourced in test.

verdict() {  # STATUS WHAT
  if [ "$1" -eq 0 ]; then echo "ok sbus: $2"; else echo "FAILED sbus: $2"; fi
}

# The bytes of a recording, one a line, without the marks of those that have errors.
bytes() { grep -v '^#' "$1" | tr -d '\r' | cut -d' ' -f2- | tr -d '!' | tr ' ' '\n' | grep .; }

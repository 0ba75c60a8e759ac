#!/bin/sh
# Builds the libFuzzer programs of fuzz/ and runs each for some seconds, from the seeds of fuzz/SEEDS ("=== PROGRAM/NAME"
# begins one, hexadecimal if it ends in "hex"; WireFuzz makes its own); says "ok ..." or "FAILED ...".
# An input that fails is written to build/test/fuzz/PROGRAM/, and running the program on it shows it again.
#
#   fuzz.sh            ten seconds each, or SECONDS=n
#
# SEED=n repeats a run.
set -u
cd "$(dirname "$0")" || exit 1
export BUILD="${BUILD:-$(cd .. && pwd)/build/test}"
seconds="${SECONDS_EACH:-10}"
seed="${SEED:-$(($(date +%s) / 86400))}"
most=3000000 # runs: enough for ten seconds of a quick machine

build() {
  "${MAKE:-make}" --no-print-directory -f build.mk OUT="$BUILD/sanitized" "$@"
}

build -k fuzz
failed=0
for program in $(build list-fuzz); do
  name=$(basename "$program")
  folder="$BUILD/fuzz/$name"
  printf '\nclang++, fuzz/%s: %s (%s s, seed %s)\n' "$name" "$(sed -n '1s,^// ,,p' "fuzz/$name.cpp")" "$seconds" "$seed"
  if ! build -q "$program" >/dev/null 2>&1; then
    echo "FAILED fuzz/$name does not build"
    failed=1
    continue
  fi
  rm -rf "$folder/corpus"
  mkdir -p "$folder/corpus"
  FOLDER="$folder/corpus" PROGRAM="$name" perl -ne 'if (/^=== (\S+)\/(\S+)( hex)?$/) {
    close SEED;
    $taken = $1 eq $ENV{PROGRAM} && open(SEED, ">", "$ENV{FOLDER}/$2");
    $hex = $3;
  } elsif ($taken) { print SEED $hex ? pack("H*", s/\s//gr) : $_ }' fuzz/SEEDS
  if SEEDS="$folder/corpus" timeout $((seconds + 60)) "$program" -max_total_time="$seconds" -runs="$most" -seed="$seed" -max_len=1024 \
    -timeout=5 -artifact_prefix="$folder/" "$folder/corpus" >"$folder/log" 2>&1; then
    tail -n 1 "$folder/log"
    echo "ok fuzz/$name"
  else
    tail -n 30 "$folder/log"
    echo "FAILED fuzz/$name, see $folder"
    failed=1
  fi
done
exit "$failed"

#!/bin/sh
# Runs every command that README.md, CONTRIBUTING.md and `make help` name as the table COMMANDS says, and says "ok ..." or
# "FAILED ...". A command that the table lacks is a failure; so is a row that no page names.
# The commands run in a copy of the repository and build nothing that other steps have built: run.sh calls this last.
# BUILD: an absolute folder for what is built.
set -u
cd "$(dirname "$0")/.." || exit 1
export BUILD="${BUILD:-$PWD/build/test}" STEP_LOGS="${STEP_LOGS:-$BUILD/steps}"
unset MAKEFLAGS MAKELEVEL CAPTURES V STEPS SKETCH RECORDING PORT PTY SCOPE_PORT PREFIX DESTDIR FRAMES SEED ONLY FULL WITHOUT TRIES
root=$PWD
out=$BUILD/commands
tab=$(printf '\t')

# Prints "PAGE:LINE<tab>COMMAND" of each line of a fenced block, each inline code that is a command, and each line of
# `make help` (page "help"). Comments there name more: `make bench`, or FULL=1 and --baud 200000 of the line's command.
named() {
  awk '
    function emit(command) { print FILENAME ":" FNR "\t" command }
    function more(command, comment,    word) {
      while (match(comment, /make (-C [a-z]+ )?[a-z]+|[A-Z_]+=(\047[^\047]*\047|[^ ,;)]*)|--[a-z-]+( [0-9]+)?/)) {
        word = substr(comment, RSTART, RLENGTH)
        comment = substr(comment, RSTART + RLENGTH)
        emit(word ~ /^make/ ? word : command " " word)
      }
    }
    function line(text, separator,    at) {
      at = match(text, separator) ? RSTART : length(text) + 1
      emit(command = substr(text, 1, at - 1))
      more(command, substr(text, at))
    }
    FILENAME == "help" && /^ / { more(command, $0) }
    FILENAME == "help" { if (/^[^ ]/) line($0, "   *"); next }
    /^```/ { fenced = !fenced; shell = !/^```(cpp|text)/; next }
    fenced { if (shell && /[^ ]/) line($0, "  *#"); next }
    {
      pieces = split($0, piece, "`")
      if (pieces > 0 && pieces % 2 == 0) emit("` without a second one on its line")
      for (i = 2; i < pieces; i += 2) {
        if (piece[i] ~ /^([A-Z_]+=(\047[^\047]*\047|[^ ]*) )*(make|(sbus|sudo|build\/[^ ]*) .+)( |$)/) emit(piece[i])
      }
    }' README.md CONTRIBUTING.md help
}

# ---- What the rows of COMMANDS call, in the copy; `line` is the command, with a stand-in for the adapter and for /sys

# it [ARGUMENTS]: runs the command with further arguments
it() { timeout 300 sh -c "$line \"\$@\"" sh "$@"; }

# live PATTERN THEN [ARGUMENTS]: runs a command that does not end: when its output has PATTERN, does THEN; then Ctrl-C
live() {
  pattern=$1 then=$2
  shift 2
  rm -f said pipe
  mkfifo pipe
  cat pipe >said &
  reader=$!  # ends with the last program that writes
  timeout 300 sh -c "$line \"\$@\"" sh "$@" >pipe 2>&1 &
  until grep -qE "$pattern" said || ! kill -0 $!; do sleep 0.1; done
  grep -qE "$pattern" said && eval "$then"
  status=$?
  kill -INT $!
  wait $reader
  cat said
  return $status
}

# adapter: a pseudo-terminal with a receiver, for 2 seconds from when it is opened
adapter() {
  rm -f terminal
  timeout 60 build/sbus/sbus simulate --seconds 2 "$@" >terminal 2>/dev/null &
  until [ -s terminal ]; do sleep 0.1; done
  line=$(echo "$line" | sed "s,/dev/ttyUSB0,$(cat terminal),")
}

# small: leaves one unit test, one example and one recording in the copy, so that what takes all of them is quick
small() {
  rm -rf test/host
  find test/unit/*Test.cpp ! -name FrameTest.cpp -delete
  find test/recordings/*.txt ! -name paper.txt -delete
  find test/golden/*.csv ! -name DecodeSBus.csv ! -name DecodeSBus-paper.csv ! -name README.csv ! -name receivers.csv -delete
  find examples -mindepth 1 -maxdepth 1 ! -name DecodeSBus -exec rm -r {} +
  find extras/docs/*.md ! -name receivers.md ! -name receiver.md ! -name measured.md -delete
  sed -i '/^DecodeSBus /!d' test/golden/LINES
}

# step NAME COMMAND: prints the log of that step of run.sh; if there is none, the output of COMMAND
step() { cat "$STEP_LOGS/$1.log" 2>/dev/null || $2; }

newlib() { [ -z "$(extras/setup/arm-specs.sh)" ] || { echo "skipped: there is no newlib for ARM here"; false; }; }

# ----

printf '\ncommands: those of the pages are run\n'
copy=$(mktemp -d)
# What was compiled in the copy names its sources there, and would not be found again.
forget() {
  grep -rlF --include='*.d' "$copy/" "$BUILD" | while read -r dependencies; do rm -f "$dependencies" "${dependencies%.d}"; done
  rm -rf "$copy"
}
trap forget EXIT
mkdir -p "$out" "$copy/build" "$copy/bin" "$BUILD/golden/g++" "$BUILD/tool" "$BUILD/scope"
tar cf - --exclude=./build --exclude=./.git . | tar xf - -C "$copy"
make -s help >"$copy/help"
(cd "$copy" && named) >"$out/named"
grep -v '^#' test/COMMANDS >"$out/rows"

# What golden.sh, tool/run.sh and scope/run.sh have built, with their flags.
ln -s "$BUILD/golden/g++" "$copy/build/host"
ln -s "$BUILD/tool" "$copy/build/sbus"
ln -s "$BUILD/scope" "$copy/build/scope"
cat >"$copy/bin/make" <<END
#!/bin/sh
case " \$* " in
  *" demo "* | *extras/host*) set -- "\$@" BUILD='$BUILD/golden/g++' CXXFLAGS='$(sed -n 's/^sanitize="\(.*\)"/\1/p' test/golden.sh)' ;;
  *" sbus "* | *" install "*) set -- "\$@" BUILD='$BUILD/tool' CXXFLAGS='$(sed -n 's/^flags="\(.*\)".*/\1/p' test/tool/run.sh)' ;;
  *" scope "*) set -- "\$@" BUILD='$BUILD/scope' ;;
  *) set -- "\$@" BUILD='$BUILD' ;;
esac
exec '$(command -v make)' --no-print-directory "\$@"
END
chmod +x "$copy/bin/make"
export PATH="$copy/bin:$copy/build/sbus:$PATH"

sort -t "$tab" -k 2 -u "$out/named" | while IFS=$tab read -r where command; do
  cut -f1 "$out/rows" | grep -qxF -e "$command" ||
    echo "FAILED commands: $where names \"$command\", which no test runs: add a row to test/COMMANDS"
done
while IFS=$tab read -r command run holds; do
  if ! cut -f2 "$out/named" | grep -qxF -e "$command"; then
    echo "FAILED commands: $command: no page names it: take it out of test/COMMANDS"
    continue
  fi
  line=$(echo "$command" | sed "s,sudo tee /sys/,tee $copy/sys/,")
  if [ "$run" != '"' ]; then
    (cd "$copy" && eval "$run") >"$out/output" 2>&1 </dev/null
    status=$?
  fi
  if grep '^skipped: ' "$out/output" >"$out/skipped"; then
    echo "skipped commands: $command: $(cut -d' ' -f2- "$out/skipped")"
  elif [ $status -eq 0 ] && [ -n "$holds" ] && tr -d '\r' <"$out/output" | grep -qE -e "$holds"; then
    echo "ok commands: $command"
  else
    tail -n 20 "$out/output" | sed 's/^/  /'
    echo "FAILED commands: $command: status $status, or nothing in its output is like $holds"
  fi
done <"$out/rows"

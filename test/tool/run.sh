#!/bin/sh
# Runs `sbus`, built by g++ with the address sanitizer, and says "ok ..." or "FAILED ..." of:
#   golden/*.csv               `sbus csv` prints what the sketches print
#   tool/REJECTIONS            what it says when it cannot do something
#   tool/RECORDINGS            what it says about each bad recording
#   recorders and players      on pseudo-terminals: stopped, killed, unplugged, on a full disk
#   the other scripts here     the first lines of each say what
#   the manual
# "run.sh update" writes tool/golden and tool/pages instead. BUILD: an absolute folder for what is built.
set -u
cd "$(dirname "$0")/.." || exit 1
out="${BUILD:-$PWD/../build/test}/tool"
sbus=$out/sbus
export SBUS="$sbus" WORK="$out/work"  # as the other scripts have them
flags="-O0 -g -fsanitize=address"  # CLI11 compiles twice as long with more
update="${1:-}"

. tool/common.sh

# Prints the bytes of a recording with the marks of errors, one a line: times differ from run to run.
marked() { grep -v '^#' "$1" | tr -d '\r' | cut -d' ' -f2- | tr ' ' '\n'; }

# Prints the whole lines, which can be read.
is_whole() {
  [ -s "$1" ] && [ -z "$(tail -c 1 "$1")" ] && "$sbus" hex "$1" >"$work/whole.txt" 2>&1 && ! grep -v '^#' "$1" | grep -vE '^[0-9]+(~[0-9]+)?( [0-9A-F]{2}!?)+$'
}

printf '\nsbus\n'
mkdir -p "$out"
echo leak:libncursesw >"$work/leaks"  # what a page has taken, ncurses 6.6 keeps
export LSAN_OPTIONS="suppressions=$work/leaks:print_suppressions=0"
if ! "${MAKE:-make}" --no-print-directory -C ../extras/cli BUILD="$out" CXX=g++ CXXFLAGS="$flags"; then
  verdict 1 "sbus builds"
  exit
fi

# ---- What it prints

# sketch GOLDEN ARGUMENTS...: csv prints what the sketch prints; its println() ends lines with CR and LF
sketch() {
  golden=golden/$1.csv
  shift
  tr -d '\r' <"$golden" >"$work/golden.csv"
  timeout 60 "$sbus" csv "$@" | tail -n 20 | cmp - "$work/golden.csv"
  verdict $? "csv prints the same as $golden"
}
sketch DecodeSBus sim --simulated-time --seconds 13.1
# csv has a frame with its last character, a sketch a character later: rows of that instant may differ.
timeout 60 "$sbus" csv sim --simulated-time --seconds 3.3 --columns ch1-ch18,age | tail -n 20 | tr , ' ' >"$work/aged"
tr -d '\r' <golden/AllChannels.csv | tr , ' ' | paste -d ' ' - "$work/aged" | awk '
  { same = 1; for (i = 1; i <= 18; i++) same = same && $i == $(i + 18); if (!same && $37 > 0.00012) bad = 1; rows += same }
  END { exit bad || rows < 14 || NR != 16 }'
verdict $? "csv prints the same as golden/AllChannels.csv, except for a frame that ends at that instant"
sketch Channels24 sim:24 --simulated-time --seconds 3.3 --columns ch1-ch24

if [ "$update" = update ]; then
  grep -v '^#' tool/LINES | while read -r name arguments; do
    # shellcheck disable=SC2086  # the arguments are words
    timeout 60 "$sbus" $arguments </dev/null | tail -n 20 >"tool/golden/$name.txt"
  done
  exec tool/pages.sh update
fi
for file in tool/golden/*.txt; do
  grep -q "^$(basename "$file" .txt) " tool/LINES || verdict 1 "a line of tool/LINES has $file"
done

coloured() { on_terminal 300 env "$@" "$SBUS" hex sim:noise=100 --simulated-time --seconds 0.05; }
coloured -u NO_COLOR TERM=xterm | cmp - tool/hex-colour.txt
verdict $? "hex has colours on a terminal"
coloured NO_COLOR=1 TERM=xterm >"$work/no-colour" && coloured -u NO_COLOR TERM=dumb | cmp - "$work/no-colour" &&
  sed 's/\x1b\[[0-9;]*m//g' tool/hex-colour.txt | cmp - "$work/no-colour"
verdict $? "hex has no colours with NO_COLOR or on a dumb terminal"

# The paper's first frame, as bytes on standard input: two of them, since the second shows where the first one ends.
frame='\017\345\003\037\370\300\007\076\360\201\017\174\340\003\006\370\200\221\075\360\201\017\174\000\000'
[ "$(printf "$frame$frame" | timeout 60 "$sbus" csv - --simulated-time --every-frame | tail -n 1)" = "997,992,992,992,0,0" ]
verdict $? "csv reads bytes from standard input"
[ "$( (printf "$frame\017"; sleep 0.1; printf "$frame" | tail -c 24) | timeout 60 "$sbus" csv - --baud 200000 --simulated-time --every-frame | wc -l)" -eq 2 ]
verdict $? "a frame that arrives in two pieces on standard input is one frame"
[ "$("$sbus" csv sim --simulated-time --seconds 0.2 --header --columns "CH1, ch18 ,State")" = "CH1,CH18,state
1248,0,ok" ]
verdict $? "--columns allows blanks and capital letters"
"$sbus" csv recordings/paper.txt --header >"$work/lf.csv" && "$sbus" csv recordings/paper.txt --header | cmp - "$work/lf.csv" &&
  [ "$(tr -dc '\r' <"$work/lf.csv" | wc -c)" -eq 0 ] && has_lines 3 "$work/lf.csv"
verdict $? "rows end with LF, in a file and in a pipe"
echo "0 $(printf "$frame" | od -An -v -tx1 | tr -d '\n')" >"$work/at-0.txt"
[ "$("$sbus" csv "$work/at-0.txt" --columns ch1,time)" = "997,0.002880" ] &&
  [ "$("$sbus" csv sim --simulated-time --seconds 0.03 --columns ch1,time)" = "1018,0.026000" ]
verdict $? "a line shorter than 0.2 s has a row with its newest frame"
"$sbus" hex sim --simulated-time --seconds 1 >/dev/full 2>"$work/err"
[ $? -eq 1 ] && [ "$(cat "$work/err")" = "sbus hex: standard output cannot be written (No space left on device); write it elsewhere" ]
verdict $? "a full standard output is reported and is a failure"
! "$sbus" hex --help >/dev/full 2>"$work/err"
verdict $? "help also fails if standard output is full"
"$sbus" record sim -o "$work/no-stderr.txt" --simulated-time --seconds 0.2 2>&- && "$sbus" hex "$work/no-stderr.txt" | grep -q 'frame end 00'
verdict $? "if standard error is closed, no message gets into the recording"
"$sbus" hex sim:silent --simulated-time --seconds 2 2>"$work/err" && grep -qx "sim: no bytes yet; run sbus doctor sim" "$work/err" &&
  "$sbus" hex sim:silent --simulated-time --seconds 1.9 2>&1 | cmp - /dev/null
verdict $? "a silent source is reported after two seconds"
# In real time: lines are written one by one, and the second finds the reader gone.
(timeout 60 "$sbus" hex sim; echo $? >"$work/status") | head -n 1 >/dev/null
[ "$(cat "$work/status")" -eq 1 ]
verdict $? "sbus ends when its reader closes the pipe"
timeout 60 "$sbus" csv "" --seconds 1 2>"$work/err"
[ $? -eq 2 ] && grep -q 'SOURCE: is empty' "$work/err"
verdict $? "an empty SOURCE is rejected"

# ---- Rejections

# rejected MESSAGE ARGUMENTS...: says that line first, and ends with 1 if a subcommand says it, with 2 if the command line is wrong
rejected() {
  message=$1
  shift
  case $message in *' lists them' | *' lists what it takes' | *' was withdrawn; '*) wanted=2 ;; "sbus $1: "*) wanted=1 ;; *) wanted=2 ;; esac
  timeout 60 "$sbus" "$@" >"$work/out" 2>"$work/err" </dev/null
  [ $? -eq $wanted ] && grep -v 'Ctrl-C ends it$' "$work/err" | sed -n 1p | grep -qxFe "$message" || { cat "$work/err"; false; }
  verdict $? "rejects: $*"
}
grep -v '^#' tool/REJECTIONS >"$work/rejections"
while IFS= read -r line; do
  # shellcheck disable=SC2086  # the arguments are words
  rejected "${line#* = }" ${line%% = *}
done <"$work/rejections"
# bad TEXT MESSAGE: a recording of this text
bad() {
  # shellcheck disable=SC2059  # the text is a format
  printf "$1" >"$work/bad.txt"
  (cd "$work" && rejected "sbus hex: bad.txt:$2" hex bad.txt)
}
sed 1d tool/RECORDINGS >"$work/recordings"
while IFS='|' read -r text message; do
  bad "$text" "$message"
done <"$work/recordings"
bad "120$(printf ' 0F%.0s' $(seq 1365))" '1: line is too long: at most 4096 characters are expected'
"$sbus" --version >"$work/version" && [ "$(head -n 1 "$work/version")" = "sbus $(sed -n 's/^version=//p' ../library.properties) (DecodeSBus)" ] &&
  grep -qE '^CLI11 [0-9.]+, libserialport [0-9.]+, libarchive [0-9.]+, ncurses [0-9.]+$' "$work/version"
verdict $? "--version prints the version, and those of the libraries: $(tail -n 1 "$work/version")"
"$sbus" 2>"$work/out"
[ $? -eq 2 ] && "$sbus" --help | cmp - "$work/out"
verdict $? "without a subcommand all are listed"
while IFS='|' read -r meant arguments; do
  # shellcheck disable=SC2086  # words
  timeout 60 "$sbus" $meant $arguments >"$work/wanted" 2>/dev/null
  status=$?
  # shellcheck disable=SC2086  # words
  timeout 60 "$sbus" $arguments >"$work/out" 2>"$work/err"
  [ $? -eq $status ] && cmp "$work/wanted" "$work/out" && sed -n 1p "$work/err" | grep -qxF "sbus: this is sbus $meant ${arguments%% *}"
  verdict $? "sbus $arguments is sbus $meant $arguments"
done <<END
summary|recordings/paper.txt
summary|recordings/paper.txt --json
monitor|sim --simulated-time --seconds 1
monitor|sim:24 --simulated-time --seconds 1
monitor|/dev/no-such-port
END
for arguments in '80 help bridge' '80 --help-all' '100 watch --help' '50 help send'; do
  # shellcheck disable=SC2086  # words
  on_terminal "${arguments%% *}" "$sbus" ${arguments#* } | tee "$work/help" | tr -s ' \n' '\n' >"$work/came"
  longest=$(wc -L <"$work/help")
  # shellcheck disable=SC2086  # words
  "$sbus" ${arguments#* } | tr -s ' \n' '\n' | cmp - "$work/came" && [ "$longest" -le "${arguments%% *}" ]
  verdict $? "help fits the terminal's width: $arguments, $longest columns"
done
for subcommand in hex doctor; do
  "$sbus" help $subcommand >"$work/help" && "$sbus" $subcommand --help | cmp - "$work/help" && grep -qE "^(Usage: )?sbus $subcommand " "$work/help"
  verdict $? "help $subcommand and $subcommand --help print the same"
done
"$sbus" help >"$work/help" && "$sbus" --help | cmp - "$work/help" && grep -qE '^(Usage: )?sbus ' "$work/help"
verdict $? "help and --help print the same"

"$sbus" wave recordings/paper.txt -o "$work/paper.vcd"
"$sbus" hex "$work/paper.vcd" >"$work/wanted" && "$sbus" wave "$work/paper.vcd" -o "$work/again.vcd" && "$sbus" hex "$work/again.vcd" | cmp - "$work/wanted"
verdict $? "wave of a capture is a capture with the same frames"
for source in sim sim:24 sim:32 sim:noise=60; do
  # A byte in hexadecimal does not tell one error from the other.
  "$sbus" hex $source --values --simulated-time --seconds 2 | sed 's/- \([0-9 ]*\)parity/- \1parity or framing/' >"$work/values.txt"
  "$sbus" hex "$work/values.txt" --values 2>"$work/err" | cmp - "$work/values.txt" && [ "$(grep -c 'end 00' "$work/values.txt")" -gt 99 ] &&
    grep -m 1 ' frame' "$work/values.txt" >"$work/wanted" && "$sbus" hex "$work/wanted" --values | cmp - "$work/wanted"
  verdict $? "what hex --values prints of $source is read again, with its times"
done
head -c 150 "$work/values.txt" >"$work/wrong.txt"
rejected "sbus hex: $work/wrong.txt:2: the row is cut: bytes and what they are, as sbus hex prints them, are expected" hex "$work/wrong.txt"
for source in sim sim:24 sim:32 sim:noise=60 sim:sbus2; do
  "$sbus" wave $source --simulated-time --seconds 10 -o "$work/printed.vcd" 2>"$work/err"
  "$sbus" hex "$work/printed.vcd" --json | grep -v '"line"\|"slot"' >"$work/wanted"
  for option in '' --characters; do
    # shellcheck disable=SC2086  # a word, or none
    "$sbus" decode "$work/printed.vcd" $option >"$work/printed.txt" 2>"$work/err"
    "$sbus" hex "$work/printed.txt" --json 2>"$work/err" | grep -v '"line"\|"slot"' | cmp - "$work/wanted"
    verdict $? "what decode ${option:-in a table} prints of $source is read again: $(grep -c '"frame"' "$work/wanted") frames"
  done
done
"$sbus" hex "$work/paper.vcd" >"$work/wanted" && { echo '$ sbus decode paper.vcd'; "$sbus" decode "$work/paper.vcd"; } >"$work/printed.txt" &&
  "$sbus" hex "$work/printed.txt" | cmp - "$work/wanted" && sed 1,3d "$work/printed.txt" >"$work/headless.txt" && "$sbus" hex "$work/headless.txt" | cmp - "$work/wanted"
verdict $? "with a terminal's prompt before it, or from the heading on, it is read, too"
sed 's/time ms/time s/' "$work/printed.txt" >"$work/wrong.txt"
rejected "sbus hex: $work/wrong.txt:4: times in ms are expected, as sbus decode prints them" hex "$work/wrong.txt"
rejected "$work/paper.vcd:24: \"24\" is not allowed after the colon; there are noise=1 to noise=100000 and uninverted" hex "$work/paper.vcd:24"
printf 'time,CH17,CH18\n0.2,0,1\n0.4,1,0\n' >"$work/times.csv"
"$sbus" monitor "$work/times.csv" --simulated-time | grep -q '^ *0\.[45][0-9]*  .*1 *0'
verdict $? "monitor shows rows with times"

# ---- Recorders and players

"$sbus" record sim -o "$work/sim.txt" --simulated-time --seconds 0.2 2>"$work/err" &&
  "$sbus" record sim -o - --simulated-time --seconds 0.2 2>"$work/err" | cmp - "$work/sim.txt"
verdict $? "record also writes to standard output"

# characters RECORDING: each character with its time, one a line
characters() {
  awk -v us="$2" '!/^#/ { late = $1; sub(/^[0-9]+/, "", late); for (i = 2; i <= NF; i++) print $1 + us * (i - 2) late, $i }' "$1" | tr -d '\r'
}
mkdir "$work/verdicts"
verdicts/lines.sh "$work/verdicts"
"$sbus" record sim:noise=100 -o "$work/noisy.txt" --simulated-time --seconds 2 2>"$work/err"
grep -q '!' "$work/noisy.txt" && [ "$("$sbus" hex "$work/noisy.txt" | wc -l)" -gt 200 ]
verdict $? "a noisy line is recorded, with the marks of errors"
for recording in "$work/noisy.txt" "$work/at-0.txt" recordings/paper.txt recordings/sbus2.txt recordings/board/rows.txt "$work/verdicts/fast.txt" "$work/verdicts/adapter-24.txt"; do
  rm -f "$work/copy.txt" "$work/again.txt"
  us=$(case $recording in *fast*) echo 60 ;; *rows*) echo 86 ;; *) echo 120 ;; esac)
  "$sbus" record "$recording" -o "$work/copy.txt" 2>"$work/err" && "$sbus" record "$work/copy.txt" -o "$work/again.txt" 2>>"$work/err"
  characters "$recording" "$us" | tr a-f A-F >"$work/characters" && [ -s "$work/characters" ] &&
    characters "$work/again.txt" "$us" | cmp - "$work/characters" && grep -v '^#' "$work/copy.txt" >"$work/lines.copy" &&
    grep -v '^#' "$work/again.txt" | cmp - "$work/lines.copy"
  verdict $? "a copy of a copy of ${recording#"$work/"} has each character at the same microsecond, also late ones and those with errors"
done
awk '!/^#/ { printf "%.6f\n", ($1 + 120 * (NF - 2)) / 1e6 }' recordings/paper.txt >"$work/ends"
"$sbus" hex recordings/paper.txt | awk '{ print $1 }' | cmp - "$work/ends" &&
  "$sbus" csv recordings/paper.txt --every-frame --columns time,ch1 | cut -d, -f1 | cmp - "$work/ends" &&
  "$sbus" record recordings/paper.txt -o - 2>&1 >"$work/out" | grep -q ': 0.4 s, 150 characters'
verdict $? "times are those of the recording"
"$sbus" monitor sim --simulated-time --seconds 0.2 >"$work/lines" && "$sbus" record sim -o "$work/record.txt" --simulated-time --seconds 0.2 2>"$work/err" &&
  "$sbus" monitor sim --simulated-time --seconds 0.2 -o "$work/monitor.txt" 2>"$work/err" | cmp - "$work/lines" &&
  sed 's/^# sbus record/# sbus monitor/' "$work/record.txt" | cmp - "$work/monitor.txt" && grep -qE '^.*monitor.txt: [1-9][0-9]* characters \(0 with errors\), [1-9][0-9]* frames$' "$work/err"
verdict $? "monitor -o writes what record writes, and shows what monitor shows"
rejected "sbus monitor: $work/monitor.txt: already exists; name another file, or remove it" monitor sim -o "$work/monitor.txt"
rejected "sbus monitor: /dev/full: could not be written completely (No space left on device); is the disk full?" monitor sim --simulated-time --seconds 1 -o /dev/full
"$sbus" monitor golden/AllChannels.csv --simulated-time -o "$work/rows.txt" >"$work/lines" 2>"$work/err" && sed 1d "$work/rows.txt" | cmp - golden/AllChannels.csv
verdict $? "monitor -o writes a sketch's rows unchanged"


player send recordings/paper.txt
"$sbus" record "$terminal" -o "$work/paper.txt" 2>"$work/err"
status=$?
wait "$player" && [ $status -eq 0 ] && marked recordings/paper.txt >"$work/paper.bytes" &&
  bytes "$work/paper.txt" | cmp - "$work/paper.bytes"
verdict $? "bytes sent through a pseudo-terminal are recorded exactly"

player send golden/AllChannels.csv --rows
"$sbus" record "$terminal" -o "$work/rows.csv" 2>"$work/err"
[ "$(head -n 1 "$work/rows.csv")" = "# sbus record $terminal: rows of CSV as the sketch printed them, not S.Bus" ] &&
  sed 1d "$work/rows.csv" | cmp - golden/AllChannels.csv
verdict $? "a sketch's rows are recorded unchanged"
tr , '\t' <golden/AllChannels.csv | "$sbus" record - --rows -o "$work/tabs.csv" 2>"$work/err"
sed 1d "$work/tabs.csv" | cmp - golden/AllChannels.csv
verdict $? "a sketch's rows between tabs are recorded with commas"
wait "$player"

for signal in INT TERM HUP KILL; do
  player send sim
  "$sbus" record "$terminal" -o "$work/$signal.txt" 2>"$work/err" &
  recorder=$!
  until_true has_lines 100 "$work/$signal.txt" && kill -$signal $recorder
  wait $recorder 2>/dev/null
  status=$?
  kill -INT "$player"
  wait "$player"
  [ $? -eq 0 ] && is_whole "$work/$signal.txt" && [ "$(grep -c ' frame ' "$work/whole.txt")" -ge 50 ] &&
    if [ $signal = KILL ]; then [ $status -gt 128 ]; else [ $status -eq 0 ] && grep -q ' frames$' "$work/err"; fi
  verdict $? "a recorder that gets SIG$signal leaves a complete recording"
done

# A disk with room for 8 KB: a write in the middle of a line fails.
(trap '' XFSZ; ulimit -f 16; "$sbus" record sim -o "$work/full.txt" --simulated-time --seconds 5) 2>"$work/err"
[ $? -eq 1 ] && is_whole "$work/full.txt" && [ "$(wc -c <"$work/full.txt")" -gt 8000 ] &&
  grep -q "^sbus record: .*full.txt: could not be written completely (File too large); what was written before is valid" "$work/err"
verdict $? "a full disk is an error, and the recording is complete up to that point"

# An adapter's name in /dev/serial/by-id is a link, which comes back with the adapter.
record_for 1 sim
player send "$lasting"
ln -sf "$terminal" "$work/adapter"
first=$player
"$sbus" record "$work/adapter" -o "$work/replugged.txt" 2>"$work/replugged.err" &
recorder=$!
wait "$first"
until_true grep -q 'the port is gone' "$work/replugged.err"
before=$(wc -l <"$work/replugged.txt")
player send sim
ln -sf "$terminal" "$work/adapter"
until_true has_lines $((before + 100)) "$work/replugged.txt" && kill -INT $recorder
wait $recorder && is_whole "$work/replugged.txt" && grep -q 'adapter: the port is back$' "$work/replugged.err"
verdict $? "recording continues when an adapter is unplugged and plugged in again"
rm "$work/adapter"  # a library has no links, not even in build/
kill -INT "$player"
wait "$player"

record_for 1 sim
player send "$lasting"
timeout 60 "$sbus" csv "$terminal" >"$work/out" 2>"$work/err" && [ "$(grep -cE '^[0-9]+(,[0-9]+){5}$' "$work/out")" -ge 2 ]
verdict $? "csv of a pseudo-terminal ends with the program at its other end"
wait "$player"

# wakeups PID: prints how often it has waited so far
wakeups() { sed -n 's/^voluntary_ctxt_switches:[^0-9]*//p' "/proc/$1/status"; }

player send sim:silent
"$sbus" monitor "$terminal" >"$work/out" 2>"$work/err" &
monitor=$!
until_true has_lines 1 "$work/out"
before=$(wakeups $monitor)
sleep 3
after=$(wakeups $monitor)
[ $((after - before)) -gt 10 ] && [ $((after - before)) -lt 150 ]
verdict $? "monitor of a silent port wakes up 20 times a second: $((after - before)) times in 3 s"
kill -INT $monitor "$player"
wait $monitor "$player"

for table in captures dumps; do
  rm -rf "$work/$table"
  mkdir "$work/$table"
  python3 "tool/$table.py" "$sbus" "$work/$table"
done
for part in wire files kinds counts send bridge stalls faults watch compare json summary stream systems telemetry recipes \
  pages doctor; do
  tool/$part.sh
  [ $? -lt 126 ] || verdict 1 "tool/$part.sh can be run"
done

# ---- Help and the manual

"$sbus" --help-all | awk '
  /^[a-z]+$/ { subcommand = $1; print subcommand }
  /^ *(-[a-z], *)?--[a-z]/ { match($0, /--[a-z0-9-]+/); option = substr($0, RSTART, RLENGTH); print (option == "--help" || option == "--help-all" || option == "--version" ? "" : subcommand " ") option }' |
  sort -u >"$work/words"
[ "$(wc -l <"$work/words")" -gt 40 ]
verdict $? "--help-all lists subcommands and options"
"$sbus" __manual <../extras/cli/sbus.1.in >"$work/sbus.1" && sed 's/\\-/-/g; s/\\f[BR]//g' "$work/sbus.1" | awk '
  /^\.S[HS] / { section = $2 == "sbus" ? $3 : "SOURCE"; print section }
  title { for (i = 1; i <= NF; i++) if ($i ~ /^--/) print section, $i }
  { title = /^\.TP/ }' >"$work/manual"
while read -r subcommand option; do
  case $subcommand in -*) line="SOURCE $subcommand" ;; *) line="$subcommand${option:+ $option}" ;; esac
  grep -qxFe "$line" "$work/manual" || grep -qxF "SOURCE $option" "$work/manual"
  verdict $? "sbus.1 has $subcommand $option"
done <"$work/words"
[ "$(grep -c -e -- "$work/manual")" -gt 40 ] && ! grep -qE "^\.(SUBCOMMAND|OPTION) " "$work/sbus.1" && ! sort "$work/manual" | uniq -d | grep -q -- --
verdict $? "sbus.1 describes an option once"
for section in 'EXIT STATUS' ENVIRONMENT FILES EXAMPLES 'SEE ALSO'; do
  grep -qx ".SH $section" "$work/sbus.1"
  verdict $? "sbus.1 has $section"
done
grep -qE '^\.TH SBUS 1 "20[0-9]{2}-[0-9]{2}-[0-9]{2}" ' "$work/sbus.1"
verdict $? "sbus.1 has a date"
WORDS=$work/words tool/completion.sh

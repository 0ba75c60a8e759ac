#!/bin/sh
# Every subcommand reads every kind of file: by its name, on standard input from the file, and through a pipe. What it
# prints is the same as for the plain file. Prints a table of the kinds, and "ok ..." or "FAILED ..." for each subcommand and kind.
set -u
cd "$(dirname "$0")/.." || exit 1
. tool/common.sh

# What other programs write: text/NAME and its packed forms. The session is sigrok's: libsigrok, src/output/srzip.c.
"$SBUS" wave recordings/sbus2.txt -o "$work/line.vcd" && cp recordings/sbus2.txt "$work/line.txt" &&
  "$SBUS" csv recordings/frsky-neutral.txt --every-frame >"$work/rows.csv" &&
  "$SBUS" csv sim --seconds 1 --simulated-time --every-frame --header --columns time,ch1-ch18,failsafe >"$work/table.csv" && python3 - "$work" <<'END'
import gzip, lzma, sys, zipfile
work = sys.argv[1] + "/"
kinds = []
for name in "line.txt", "line.vcd", "rows.csv":
    text = open(work + name, newline="").read().replace("\r\n", "\n")
    stem, end = name.split(".")
    def keep(kind, data):
        open(work + f"{stem}-{kind}", "wb").write(data)
        kinds.append(f"{name} {stem}-{kind}")
    if end != "csv":  # of rows the CR counts as a byte of the line
        keep("crlf." + end, text.replace("\n", "\r\n").encode())
    keep("mark." + end, b"\xEF\xBB\xBF" + text.encode())
    keep("utf16le." + end, b"\xFF\xFE" + text.encode("utf-16-le"))
    keep(end + ".gz", gzip.compress(text.encode()))
    keep(end + ".xz", lzma.compress(text.encode()))
    keep("utf16le." + end + ".gz", gzip.compress(b"\xFF\xFE" + text.encode("utf-16-le")))
    keep(end + "-misnamed.bin", gzip.compress(text.encode()))
    with zipfile.ZipFile(work + f"{stem}-{end}.zip", "w", zipfile.ZIP_DEFLATED) as packed:
        packed.writestr("folder/", b"")
        packed.writestr("folder/.DS_Store", b"\0\0\0\1Bud1")  # as macOS packs it
        packed.writestr("folder/" + name, text)
        packed.writestr("__MACOSX/folder/._" + name, b"\0\5\x16\7\0\2\0\0Mac OS X        ")
    kinds.append(f"{name} {stem}-{end}.zip")
for name in "rows", "table":  # as spreadsheets in German save them: decimal commas
    text = open(work + name + ".csv").read().replace(".", ",,")
    for end, mark in ("csv", ";"), ("tsv", "\t"):
        open(work + f"{name}-german.{end}", "w").write(text.replace(",,", "?").replace(",", mark).replace("?", ","))
        kinds.append(f"{name}.csv {name}-german.{end}")
levels, samples, level = [], bytearray(), 0
for line in open(work + "line.vcd"):
    if line[0] == "#":
        samples += bytes([level]) * (int(line[1:]) - len(samples))
    elif line[0] in "01":
        level = int(line[0])
with zipfile.ZipFile(work + "line-session.sr", "w", zipfile.ZIP_DEFLATED) as session:
    session.writestr("version", "2")
    session.writestr("metadata", "[device 1]\ncapturefile=logic-1\nsamplerate=1 MHz\nprobe1=SBUS\nunitsize=1\n")
    session.writestr("logic-1-1", bytes(samples[:len(samples) // 2]))
    session.writestr("logic-1-2", bytes(samples[len(samples) // 2:]))
kinds.append("line.vcd line-session.sr")
open(work + "kinds", "w").write("\n".join(kinds) + "\n")
END
[ "$(wc -l <"$work/kinds")" -eq 28 ]
verdict $? "there are 28 kinds of files"

run() {  # SUBCOMMAND 'FILE OPTION...', in $work: what it prints, without the file's name
  # shellcheck disable=SC2086  # the arguments are words
  case $1 in
    record) "$SBUS" record $2 -o - 2>said && cat said ;;  # one after the other
    send) "$SBUS" send $2 --port /dev/null ;;  # says that this is no port, once the file is read
    monitor) "$SBUS" monitor $2 --simulated-time ;;
    csv) "$SBUS" csv $2 --every-frame --columns time,ch1-ch18,failsafe ;;
    decode) "$SBUS" decode $2 ;;
    report) "$SBUS" summary $2 -o - ;;
    *) "$SBUS" "$1" $2 ;;
  esac 2>&1 | sed -e 's#standard input#input#; s#^\(sbus [a-z]*: \)*-:#\1input:#; s#^-,#input,#; s#record -\(:.*\)*$#record input\1#' \
    -e 's#decode -$#decode input#; s#<input$#<-#; s#, sigrok session:#, VCD:#'
}
cd "$work" || exit 1
for subcommand in monitor doctor summary telemetry hex csv report record send decode wave; do
  bad=
  while read -r plain kind; do
    # A name that does not tell what it is.
    cp "$plain" input && run $subcommand input >wanted
    cp "$kind" input && run $subcommand input >by-name
    run $subcommand - <"$kind" >on-input
    # shellcheck disable=SC2002  # a pipe, not a file
    cat "$kind" | run $subcommand - >by-pipe
    for way in by-name on-input by-pipe; do
      cmp -s wanted $way && [ -s wanted ] || bad="$bad $kind:$way"
    done
  done <kinds
  [ -z "$bad" ]
  verdict $? "$subcommand reads every kind of file$bad"
done

# ---- Two signals in a capture: each subcommand says which it took, and --signal chooses.

"$SBUS" wave "$OLDPWD/recordings/frsky-neutral.txt" -o other.vcd && python3 - <<'END'
def changes(name, code):
    us = 0
    for line in open(name):
        if line[0] == "#":
            us = int(line[1:])
        elif line[0] in "01":
            yield us, line[0] + code
both = sorted(list(changes("line.vcd", "!")) + list(changes("other.vcd", "%")), key=lambda change: change[0])
for name, code in ("line.vcd", "!"), ("other.vcd", "%"):  # all end at the same time
    if list(changes(name, code))[-1][0] < both[-1][0]:
        with open(name, "a") as file:
            file.write(f"#{both[-1][0]}\n")
with open("two.vcd", "w") as file:
    file.write("$timescale 1 us $end\n$var wire 1 ! TAIL $end\n$var wire 1 % MAIN $end\n$enddefinitions $end\n")
    for us, change in both:
        file.write(f"#{us} {change}\n")
END
first=$("$SBUS" decode two.vcd | sed -n 's/^signal \([A-Z]*\) carries S.Bus, as does [A-Z]*: .*/\1/p')
[ "$first" = TAIL ] || [ "$first" = MAIN ]
verdict $? "decode says which signal it chose: ${first:-none}"
for subcommand in monitor doctor summary telemetry hex csv report record send; do
  bad=
  run $subcommand two.vcd >said
  grep -q "^two.vcd: this is signal $first; S.Bus is also on [A-Z]*: --signal NAME chooses$" said || bad="$bad says-nothing"
  for signal in TAIL:line MAIN:other; do
    # shellcheck disable=SC2016  # the option follows the file's name
    cp "${signal#*:}.vcd" input && run $subcommand input >wanted
    cp two.vcd input && run $subcommand "input --signal ${signal%:*}" >chosen
    cmp -s wanted chosen || bad="$bad $signal"
  done
  [ -z "$bad" ]
  verdict $? "$subcommand says which of two signals it chose, and --signal chooses another:$bad"
done
"$SBUS" hex two.vcd --signal TX 2>err
[ $? -eq 1 ] && grep -qx 'sbus hex: two.vcd: there is no signal TX: one of TAIL, MAIN is expected' err
verdict $? "a wrong --signal lists the signals"

# A file from a pipe that stays open is read until Ctrl-C.
mkfifo open
{ cat line.txt; exec sleep 60; } >open &
writer=$!
timeout --foreground -s INT 2 "$SBUS" hex - <open >by-pipe 2>err
"$SBUS" hex line.txt | cmp - by-pipe
verdict $? "a file from a pipe that stays open is read until Ctrl-C"
kill $writer

#!/bin/sh
# hex, telemetry, summary and doctor count the same on the same recordings, and say that times are not known where they are
# not.
set -u
cd "$(dirname "$0")/.." || exit 1
. tool/common.sh

# Lines of each variant, clean and with noise: S.BUS2, end byte 08 with five more bytes, 24 and 32 channels.
cp recordings/sbus2.txt "$work/real-sbus2.txt"
for line in 16 24 32 sbus2; do
  "$SBUS" record sim:$line -o "$work/$line.txt" --simulated-time --seconds 3 2>"$work/err"
done
awk '/^#/ || NF != 26 { print; next } { $26 = "08"; print $0, "00 03 C0 33 00" }' "$work/16.txt" >"$work/08.txt"
for name in 16 24 32 sbus2 08; do
  "$SBUS" record "$work/$name.txt:noise=40" -o "$work/$name-noise.txt" --simulated-time 2>"$work/err"
done
python3 - "$SBUS" "$work" "$work"/*.txt <<'END'
import json, os, subprocess, sys
sbus, work, *files = sys.argv[1:]
def run(*arguments):
    return subprocess.run([sbus, *arguments], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout
def lines(*arguments):
    return [json.loads(line) for line in run(*arguments, "--json").splitlines()]
wrong = 0
slots_seen = discarded_seen = 0
for file in files:
    frames = slots = discarded = errors = in_frames = 0
    for line in lines("hex", file):
        if line["type"] == "frame":
            frames += line["first"] == 1
            in_frames += 36 if len(line["channels"]) == 24 else 25
        elif line["type"] == "slot":
            slots += 1
        elif line["type"] == "no_frame":
            discarded += sum("!" not in byte for byte in line["bytes"].split())
            errors += line["bytes"].count("!")
        elif line["type"] == "end":
            telemetry = line["characters"] - in_frames - discarded - errors
    summary = lines("summary", file)[1]
    trial = next(line for line in lines("doctor", file) if line.get("frames"))
    counts = {
        "hex": (frames, slots, telemetry, discarded, errors),
        "telemetry": (frames, run("telemetry", file).count("\n") - 1, telemetry, discarded, errors),
        "summary": (summary["frames"], slots, telemetry, summary["discarded_bytes"], summary["character_errors"]),
        "doctor": (trial["frames"], slots, trial["telemetry_bytes"], trial["discarded_bytes"], trial["character_errors"])}
    slots_seen += slots
    discarded_seen += discarded
    if len(set(counts.values())) != 1:
        wrong += 1
        print(os.path.basename(file), counts)
sys.exit(wrong > 0 or len(files) != 11 or slots_seen < 500 or discarded_seen < 3000)
END
verdict $? "hex, telemetry, summary and doctor agree on frames, slots, discarded bytes and character errors of 11 lines"

# A link state has one name everywhere.
"$SBUS" monitor "$work/16.txt" --simulated-time | sed 's/^[0-9.]*  \([a-z ]*\)  .*/\1/' | sort -u >"$work/text"
"$SBUS" monitor "$work/16.txt" --simulated-time --json | sed 1d | sed 's/.*"state":"\([a-z ]*\)".*/\1/' | sort -u >"$work/json"
{ echo 'never seen'; "$SBUS" csv "$work/16.txt" --every-frame --columns state; } | sort -u >"$work/csv"
for form in json csv; do
  [ -s "$work/$form" ] && ! comm -23 "$work/$form" "$work/text" | grep -qvx 'lossy'
  verdict $? "a link state has the same name in $form as in the text"
done

# A frame's time is the end of its last byte: in hex, its JSON, csv, and decode.
"$SBUS" wave "$work/16.txt" -o "$work/16.vcd"
"$SBUS" hex "$work/16.txt" | awk '/ frame end / { printf "%.0f\n", $1 * 1e6 }' >"$work/times"
"$SBUS" hex "$work/16.txt" --json | sed -n 's/.*"frame","time_us":\([0-9]*\).*/\1/p' | cmp - "$work/times"
verdict $? "hex --json has the times of hex"
"$SBUS" csv "$work/16.txt" --every-frame --columns time | awk '{ printf "%.0f\n", $1 * 1e6 }' | cmp - "$work/times"
verdict $? "csv has the times of hex"
"$SBUS" decode "$work/16.vcd" | awk '/^ +[0-9.]+ +[0-9]/ { printf "%.0f\n", $1 * 1e3 }' | cmp - "$work/times"
verdict $? "decode has the times of hex"

# ---- Bytes from a pipe, and from a file, have no times.

grep -v '^#' "$work/sbus2.txt" | cut -d' ' -f2- | tr ' ' '\n' | python3 -c '
import sys; sys.stdout.buffer.write(bytes(int(word, 16) for word in sys.stdin.read().split()))' >"$work/bytes.bin"
said='times are not known'
for way in pipe input file; do
  while IFS='|' read -r subcommand wanted; do
    # shellcheck disable=SC2086,SC2002  # the arguments are words; a pipe, not a file
    case $way in
      pipe) cat "$work/bytes.bin" | "$SBUS" $subcommand - ;;
      input) "$SBUS" $subcommand - <"$work/bytes.bin" ;;
      file) "$SBUS" $subcommand "$work/bytes.bin" ;;
    esac >"$work/out" 2>"$work/err"
    grep -q "$said" "$work/err" && [ "$(grep -cE "$wanted" "$work/out")" -ge 1 ] && ! grep -E "$wanted" "$work/out" | grep -qE '[0-9] frames (a second|[a-z ]*interval)|"frame","time_us":[0-9]|[0-9] frames/s|gap min' || { cat "$work/out" "$work/err"; false; }
    verdict $? "$subcommand of bytes without times, by $way, prints no times and says so"
  done <<'END'
hex|^ +-  0F
hex --json|"frame","time_us":null
csv --every-frame --columns time,age,ch1|^-,-,[0-9]+$
summary|^frames       -, times are not known$
summary --json|"from_us":null,"to_us":null
telemetry|^-,0,
doctor|^S.BUS2: times are not known; [0-9]+ % with the lost-frame flag$
doctor --json|"heard_ms":null
monitor --seconds 0.3|  ok .*  - frames/s,
monitor --json --seconds 0.3|"frames_per_second":null
END
done
# Of bytes between frames, such as a receiver's breaks, only a file tells beforehand.
"$SBUS" record sim -o "$work/direct.txt" --simulated-time --seconds 2 2>"$work/err"
bytes "$work/direct.txt" | python3 -c '
import sys; sys.stdout.buffer.write(bytes(int(word, 16) for word in sys.stdin.read().split()))' >"$work/direct.bin"
# shellcheck disable=SC2002  # a pipe, not a file
cat "$work/direct.bin" | "$SBUS" hex - >"$work/piped" 2>"$work/err" && "$SBUS" hex "$work/direct.bin" 2>"$work/note" | cmp - "$work/piped" &&
  grep -qx -- '-: bytes without times: times are not known, played as fast as a line' "$work/err"
verdict $? "bytes that come at once through a pipe play at the line's rate, which is said: $(cat "$work/err")"

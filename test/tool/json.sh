#!/bin/sh
# Compares every JSON line that `sbus` prints with the manual's section JSON LINES, and says "ok ..." or "FAILED ...": each
# field is there with the type of its name, and each field of the manual occurs.
set -u
cd "$(dirname "$0")/.." || exit 1
. tool/common.sh

run() { timeout 60 "$SBUS" "$@" --json >>"$work/all" 2>"$work/err" </dev/null; }

: >"$work/all"
"$SBUS" wave recordings/sbus2.txt -o "$work/sbus2.vcd"
for channels in 16 24 32; do
  run hex sim:noise=20,$channels --simulated-time --seconds 0.5
  run monitor sim:$channels --simulated-time --seconds 2
done
run monitor sim --simulated-time --seconds 11
run monitor sim:silent --simulated-time --seconds 1
run monitor golden/DecodeSBus.csv --simulated-time
run doctor sim:uninverted --simulated-time
run doctor golden/DecodeSBus.csv
run hex "$work/sbus2.vcd"
run summary sim --simulated-time --seconds 14
run summary recordings/sbus2.txt
run telemetry recordings/sbus2.txt
run hex sim --simulated-time --seconds 0.1
run watch sim --simulated-time --seconds 20 --when failsafe -o "$work/events"
run compare sim sim:noise=20 --simulated-time --seconds 5
"$SBUS" hex sim --simulated-time --seconds 5 --json | sed '100s/\[[0-9]*,/[2000,/' >"$work/other.json"
run compare sim "$work/other.json" --simulated-time --seconds 5
run summary "$work/other.json"  # frame 100 is a jump of CH1
run ports
run hex sim --seconds 0.2  # in real time
"$SBUS" record sim:noise=20 -o "$work/port.txt" --simulated-time --seconds 0.5 2>"$work/err"
sed -E '/^#/!s/^[0-9]+/&~18000/' "$work/port.txt" >"$work/late.txt"
run hex "$work/late.txt"
python3 - "$work/all" ../extras/cli/sbus.1.in "$SBUS" <<'END'
import json, os, re, subprocess, sys
manual = open(sys.argv[2]).read().replace("\\-", "-")
section = manual[manual.index(".SH JSON LINES"):].split("\n.SH ")[0]
fields = {}
for block in section.split("\n.TP\n")[1:]:
    name, rest = re.match(r"\.B (\w+)\n(.*)", block, re.S).groups()
    fields[name] = re.findall(r"\w+", rest.split("\n.br\n")[0])
seen, wrong, states = set(), [], set()
def check(line):
    try:
        object = json.loads(line)
    except ValueError as error:
        return wrong.append("%s: %s" % (error, line))
    kind = object.get("type")
    states.add(object.get("state"))
    for name, value in object.items():
        expected = (str if name in ("type", "signal", "end", "bytes", "why", "state", "polarity", "finding", "remedy", "line", "message", "name", "description", "usb_vendor", "usb_product", "serial_number", "known_as", "kind", "source", "start", "quantity", "unit", "date", "file", "by", "only", "evidence", "rates", "scales") else
                    list if name in ("channels", "values", "data") else
                    bool if name in ("ch17", "ch18", "dg1", "dg2", "lost_frame", "failsafe", "inverted", "timed", "has_24_channels", "rows_of_csv", "well", "permission", "by_contents", "certain", "late_delay") else
                    (int, float))
        if not isinstance(value, expected) or (expected != bool and isinstance(value, bool)):
            wrong.append("%s of %s is %r" % (name, kind, value))
        if name != "type" and name not in fields.get(kind, []):
            wrong.append("the manual has no %s of %s" % (name, kind))
        seen.add((kind, name))
for line in open(sys.argv[1]):
    check(line)
# The PC may have no serial port, no port by USB, and no adapter with a latency timer.
rare = {("line", "start"), ("event", "date"), ("line", "timed")} | {("port", name) for name in fields["port"]} | {("error", "message")}
wrong += ["no %s of %s came" % (name, kind) for kind in fields for name in fields[kind] if (kind, name) not in seen | rare]
wrong += ["no state " + state for state in ("never seen", "ok", "lossy", "failsafe") if state not in states]
if wrong:
    print("\n".join(sorted(set(wrong))[:20]))
sys.exit(bool(wrong) or len(fields) < 10)
END
verdict $? "JSON lines agree with the manual"

# The figures are the same as in the other forms.
line="sim:noise=5 --simulated-time --seconds 10"
# shellcheck disable=SC2086  # the arguments are words
"$SBUS" hex $line --json | sed -n 's/.*"channels":\[\(.*\)\],"ch17":\(.*\),"ch18":\(.*\),"lost_frame":\(.*\),"fail.*/\1,\2,\3,\4/p' | sed 's/false/0/g; s/true/1/g' >"$work/json" &&
  "$SBUS" csv $line --every-frame --columns ch1-ch18,lostframe | tr -d '\r' | cmp - "$work/json" && [ "$(wc -l <"$work/json")" -gt 900 ] && grep -q ',1$' "$work/json"
verdict $? "hex --json has the frames of csv"
for channels in 16 24; do
  line="sim:noise=20,$channels --simulated-time --seconds 0.2"
  # shellcheck disable=SC2086  # the arguments are words
  "$SBUS" hex $line --values | awk -v count=$channels '/  (frame|frame24) end/ { for (i = NF - count + 1; i < NF; i++) printf "%s,", $i; print $NF }' >"$work/values" &&
    "$SBUS" csv $line --every-frame --columns ch1-ch$channels | cmp - "$work/values" && [ "$(wc -l <"$work/values")" -gt 10 ]
  verdict $? "hex --values of $channels channels agrees with csv"
done
"$SBUS" doctor sim --simulated-time --json >"$work/doctor"
[ $? -eq 0 ] && [ "$(wc -l <"$work/doctor")" -eq 2 ] && tail -n 1 "$work/doctor" | grep -q '"well":true,"finding":"All well' && ! "$SBUS" doctor sim:uninverted --simulated-time --json >"$work/doctor" &&
  [ "$(wc -l <"$work/doctor")" -eq 5 ] && tail -n 1 "$work/doctor" | grep -q '"well":false,"finding":"Wrong polarity'
verdict $? "doctor --json has the verdict and the exit status"
"$SBUS" hex sim:24 --simulated-time --seconds 2 --json | sed '100s/\(\[\([0-9]*,\)\{19\}\)[0-9]*,/\12000,/' >"$work/jump.json"
"$SBUS" summary "$work/jump.json" --json | grep -q '"kind":"jump",.*"channels":\[20\]}$'
verdict $? "summary --json of a jump names its channel, CH20"
cp recordings/paper.txt "$work/$(printf 'caf\351\n\033')"
(cd "$work" && "$SBUS" hex caf* --json) | python3 -c 'import json, sys
assert json.loads(sys.stdin.buffer.readline().decode())["source"] == "caf\uFFFD\n\x1b"'
verdict $? "a name that is not UTF-8 is valid JSON"
printf '$timescale 1us $end\n$var wire 1 ! a"b\\c $end\n$enddefinitions $end\n' >"$work/odd.vcd"
sed '1,/enddefinitions/d' "$work/sbus2.vcd" >>"$work/odd.vcd"
"$SBUS" hex "$work/odd.vcd" --json | python3 -c 'import json, sys
[json.loads(line) for line in sys.stdin]' && "$SBUS" hex "$work/odd.vcd" --json | grep -q '"signal":"a\\"b'
verdict $? "a name with a quotation mark and a backslash is valid JSON"

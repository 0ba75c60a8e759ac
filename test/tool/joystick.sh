#!/bin/sh
# Tests the events that a program reads from the game controller of `sbus joystick`; says "ok ..." or "FAILED ...".
# The controller is at a stand-in for /dev/uinput, Uinput.cpp, which logs them; where a real one can be opened, also there.
set -u
cd "$(dirname "$0")/.." || exit 1
. tool/common.sh

# shellcheck disable=SC2046  # flags
g++ -std=c++17 -Wall -Wextra -O1 -fPIC -shared $(pkg-config --cflags libevdev) tool/Uinput.cpp $(pkg-config --libs libevdev) -o "$work/uinput.so"
verdict $? "tool/Uinput builds"
export UINPUT_LOG="$work/log"

# The address sanitizer has to come first.
preload="$(g++ -print-file-name=libasan.so) $work/uinput.so"
joystick() { LD_PRELOAD="$preload" timeout 60 "$SBUS" joystick "$@" 2>"$work/err"; }

# last: what the controller shows at the end, "X Y Z RX RY RZ THROTTLE RUDDER | the numbers of the buttons that are pressed"
last() {
  tr ' ' '\n' <"$UINPUT_LOG" | awk -F= '
    BEGIN {
      split("X Y Z RX RY RZ THROTTLE RUDDER", axis, " ")
      split("SOUTH EAST C NORTH WEST Z TL TR TL2 TR2 SELECT START MODE THUMBL THUMBR", button, " ")
      for (i = 1; i <= 24; i++) name[i] = i < 16 ? "BTN_" button[i] : i == 16 ? "1:319" : "BTN_TRIGGER_HAPPY" i - 16
    }
    /destroyed/ { exit }
    { value[$1] = $2 }
    END {
      for (i = 1; i <= 8; i++) printf "%d ", value["ABS_" axis[i]]
      printf "|"
      for (i = 1; i <= 24; i++) if (value[name[i]]) printf " %d", i
      print ""
    }'
}

# ---- The device, and every event of a flight with lost frames, failsafe and all that

rm -f "$UINPUT_LOG"
joystick sim --simulated-time --seconds 14
[ "$(head -n 1 "$UINPUT_LOG")" = "created \"S.Bus transmitter\" $(for axis in X=0 Y=0 Z=-1000 RX=0 RY=0 RZ=0 THROTTLE=0 RUDDER=0; do printf 'ABS_%s of -1000..1000 ' $axis; done)buttons: 24" ] &&
  [ "$(tail -n 1 "$UINPUT_LOG")" = destroyed ]
verdict $? "the controller begins at rest with the throttle low, and is removed at the end"
"$SBUS" csv sim --simulated-time --seconds 14 --every-frame --columns ch1-ch18,state | tr -d '\r' | awk -F, '
  function put(name, value) { if (value != is[name]) { line = line (line == "" ? "" : " ") name "=" value; is[name] = value } }
  function part(raw,    x) { x = (raw - 992) * 1000 / (raw < 992 ? 820 : 819); x = int(x + (x < 0 ? -0.5 : 0.5)); return x < -1000 ? -1000 : x > 1000 ? 1000 : x }
  function report(link,    i) {
    line = ""
    for (i = 1; i <= 8; i++) put("ABS_" axis[i], link ? part($i) : i == 3 ? -1000 : 0)
    for (i = 9; i <= 18; i++) put("BTN_" button[i - 8], link && (i < 17 ? part($i) > 500 : $i) ? 1 : 0)
    if (line != "") print line
  }
  BEGIN {
    split("X Y Z RX RY RZ THROTTLE RUDDER", axis, " ")
    split("SOUTH EAST C NORTH WEST Z TL TR TL2 TR2", button, " ")
    for (i = 1; i <= 8; i++) is["ABS_" axis[i]] = i == 3 ? -1000 : 0
    for (i = 1; i <= 10; i++) is["BTN_" button[i]] = 0
  }
  { report($19 == "ok" || $19 == "lossy") }
  END { report(0) }' >"$work/wanted"
sed '1d; $d' "$UINPUT_LOG" | diff - "$work/wanted" >"$work/diff" && [ "$(wc -l <"$work/wanted")" -gt 900 ]
verdict $? "each frame causes one report of the changes, also during lost frames and failsafe"
head -n 5 "$work/diff"
! grep dropped "$UINPUT_LOG"
verdict $? "the kernel drops no event"

# ---- Maps, ranges and calibrations, by frames with chosen values

# CH1 and CH4 are not at the middle, CH2 and CH3 are reversed, the rest is as --range says.
cat >"$work/radio.txt" <<'END'
# sbus calibrate: raw values at -100, 0 and +100 %
CH1 200 1010 1800

CH2 1780 980 180   # reversed
 CH3 1811 992 173
CH4 292 1000 1692
CH10 100 400 1000
END

# CHn is 100 n, of 0..2000: -900 at CH1, 0 at CH10, 600 at CH16.
ramp=$(for n in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16; do printf 'ch%d=%d00 ' $n $n; done)
while IFS='|' read -r options values axes buttons; do
  # shellcheck disable=SC2086  # they are words
  record_for 0.4 "$(eval echo $values | tr ' ' ,)"
  player send "$lasting"
  rm -f "$UINPUT_LOG"
  # shellcheck disable=SC2046,SC2086
  joystick "$terminal" --failsafe hold $(eval echo $options)
  kill "$player" 2>/dev/null  # it waits for a reader
  wait "$player"
  [ "$(last)" = "$axes |$buttons" ] || { last; cat "$work/err"; false; }
  verdict $? "joystick $options with $values shows $axes |$buttons"
done <<'END'
|ch1=172 ch2=1811 ch4=993 ch6=991 ch7=0 ch8=2047|-1000 1000 -1000 1 0 -1 -1000 1000|
|ch9=1811 ch10=1402 ch11=1401 ch16=1500 ch18=on|0 0 -1000 0 0 0 0 0| 1 2 8 10
--range futaba|ch1=352 ch2=1024 ch3=1696 ch4=1024 ch5=1025 ch6=1024 ch7=1360 ch8=0 ch17=1|-1000 0 1000 0 1 0 500 -1000| 9
--range 0,1000,2000|$ramp|-900 -800 -700 -600 -500 -400 -300 -200| 8
--range 2000,1000,0|$ramp|900 800 700 600 500 400 300 200|
--range 0,1000,2000 --map mode1|$ramp|-600 800 -500 -900 700 -400 -300 -200| 8
--range 0,1000,2000 --map mode2|$ramp|-600 700 -500 -900 800 -400 -300 -200| 8
--range 0,1000,2000 --map mode3|$ramp|-900 800 -500 -600 700 -400 -300 -200| 8
--range 0,1000,2000 --map mode4|$ramp|-900 700 -500 -600 800 -400 -300 -200| 8
--calibration $work/radio.txt|ch1=1800 ch2=1780 ch3=1811 ch4=1000 ch5=1811 ch10=701 ch11=1403|1000 -1000 -1000 0 1000 0 0 0| 2 3
--calibration $work/radio.txt|ch1=605 ch2=580 ch3=992 ch4=1346 ch5=1401 ch10=700 ch11=1401|-500 500 0 500 499 0 0 0|
--calibration $work/radio.txt --range 0,1000,2000|ch1=1010 ch2=180 ch3=173 ch5=1000 ch6=2000 ch10=0 ch11=1400|0 1000 1000 -11 0 1000 -8 -8|
--range 0,1000,2000 --map -16,9,15,10,14,11,-13,12|$ramp|-600 -100 500 0 400 100 -300 200|
END

# ---- Without a link

# CH1, CH3 and CH9 at their ends; then a lost frame that brings another CH1, failsafe, and CH1 back.
cat >"$work/losses.csv" <<'END'
time,ch1,ch3,ch9,lostframe,failsafe
0.2,1811,1811,1811,0,0
0.4,992,1811,1811,1,0
0.6,172,172,172,0,1
0.8,172,1811,1811,0,0
1.0,172,1811,1811,0,0
END
while IFS='|' read -r options wanted; do
  player send "$work/losses.csv"
  rm -f "$UINPUT_LOG"
  # shellcheck disable=SC2046,SC2086
  joystick "$terminal" $(eval echo $options)
  kill "$player" 2>/dev/null
  wait "$player"
  [ "$(sed 's/created.*buttons: 24/created/' "$UINPUT_LOG" | paste -sd ,)" = "created,$wanted,destroyed" ] || { cat "$UINPUT_LOG" "$work/err"; false; }
  verdict $? "joystick $options without a link shows $wanted"
done <<'END'
|ABS_X=1000 ABS_Z=1000 BTN_SOUTH=1,ABS_X=0,ABS_Z=-1000 BTN_SOUTH=0,ABS_X=-1000 ABS_Z=1000 BTN_SOUTH=1,ABS_X=0 ABS_Z=-1000 BTN_SOUTH=0
--failsafe hold|ABS_X=1000 ABS_Z=1000 BTN_SOUTH=1,ABS_X=0,ABS_X=-1000
--throttle 1|ABS_X=1000 ABS_Z=1000 BTN_SOUTH=1,ABS_X=0,ABS_X=-1000 ABS_Z=0 BTN_SOUTH=0,ABS_Z=1000 BTN_SOUTH=1,ABS_Z=0 BTN_SOUTH=0
--throttle -3|ABS_X=1000 BTN_SOUTH=1,ABS_X=0,BTN_SOUTH=0,ABS_X=-1000 BTN_SOUTH=1,ABS_X=0 BTN_SOUTH=0
--throttle -3 --map 1,2,-3,4,5,6,7,8|ABS_X=1000 BTN_SOUTH=1,ABS_X=0,BTN_SOUTH=0,ABS_X=-1000 BTN_SOUTH=1,ABS_X=0 BTN_SOUTH=0
--map 1,2,-3,4,5,6,7,8|ABS_X=1000 ABS_Z=-1000 BTN_SOUTH=1,ABS_X=0,ABS_Z=1000 BTN_SOUTH=0,ABS_X=-1000 ABS_Z=-1000 BTN_SOUTH=1,ABS_X=0 ABS_Z=1000 BTN_SOUTH=0
--calibration $work/radio.txt|ABS_X=1000 ABS_Y=-15 ABS_RX=-11 BTN_SOUTH=1 BTN_EAST=1,ABS_X=-22,ABS_X=0 ABS_Y=0 ABS_RX=0 BTN_SOUTH=0 BTN_EAST=0,ABS_X=-1000 ABS_Y=-15 ABS_RX=-11 BTN_SOUTH=1 BTN_EAST=1,ABS_X=0 ABS_Y=0 ABS_RX=0 BTN_SOUTH=0 BTN_EAST=0
--map mode2|ABS_Y=-1000 ABS_RX=1000 BTN_SOUTH=1,ABS_RX=0,ABS_Y=1000 BTN_SOUTH=0,ABS_Y=-1000 ABS_RX=-1000 BTN_SOUTH=1,ABS_Y=1000 ABS_RX=0 BTN_SOUTH=0
END

# Lines of 24 and 32 channels: CH17 and CH18 are no switches there, and frames with header 2F come between.
for channels in 24 32; do
  rm -f "$UINPUT_LOG"
  joystick sim:$channels --simulated-time --seconds 2 --failsafe hold --range 0,400,700
  "$SBUS" csv sim:$channels --simulated-time --seconds 2 --every-frame --columns ch9-ch$channels | tail -n 1 |
    tr -d '\r' | tr , '\n' | awk '$1 > 550 { printf " %d", NR }' >"$work/pressed"
  [ "$(last | cut -d '|' -f 2)" = "$(cat "$work/pressed")" ]
  verdict $? "a line of $channels channels has its buttons:$(cat "$work/pressed")"
  rm -f "$UINPUT_LOG"
  joystick sim:$channels --simulated-time --seconds 2 --range 0,400,700
  [ "$(grep -o '1:319=.' "$UINPUT_LOG" | paste -sd ,)" = 1:319=1,1:319=0 ]  # CH24's
  verdict $? "a line of $channels channels never loses the link before the end"
done

# An adapter that is unplugged, and plugged in again.
record_for 1 ch1=1811,ch3=1811
player send "$lasting"
ln -sf "$terminal" "$work/adapter"
rm -f "$UINPUT_LOG"
LD_PRELOAD="$preload" "$SBUS" joystick "$work/adapter" 2>"$work/err" &
reader=$!
has_reports() { [ "$(grep -c '^ABS' "$UINPUT_LOG")" -ge "$1" ]; }
until_true grep -q 'the port is gone' "$work/err" && until_true has_reports 2
wait "$player"
player send ch1=172 ch3=1811
ln -sf "$terminal" "$work/adapter"
until_true has_reports 3
kill -INT $reader
wait $reader && kill -INT "$player" && wait "$player" && ! grep unread "$UINPUT_LOG" &&
  [ "$(grep '^ABS' "$UINPUT_LOG" | paste -sd ,)" = "ABS_X=1000 ABS_Z=1000,ABS_X=0 ABS_Z=-1000,ABS_X=-1000 ABS_Z=1000,ABS_X=0 ABS_Z=-1000" ]
verdict $? "unplugging the adapter lowers the throttle, and plugging it in continues"
rm "$work/adapter"

# The recording ends with silence, which closes the throttle before the end does.
rm -f "$UINPUT_LOG"
joystick recordings/paper.txt --simulated-time
grep -q '^ABS' "$UINPUT_LOG" && ! grep unread "$UINPUT_LOG"
verdict $? "programs have time to read the last report before the controller is removed"

echo '{"type":"frame","channels":[1811,1811,1811' >"$work/half.json"
"$SBUS" hex recordings/paper.txt --json | cat - "$work/half.json" >"$work/cut.json"
rm -f "$UINPUT_LOG"
! joystick "$work/cut.json" --simulated-time && grep -q 'cut.json: ends within an object' "$work/err" && [ "$(last)" = "0 0 -1000 0 0 0 0 0 |" ] && ! grep unread "$UINPUT_LOG" || { last; cat "$work/err"; false; }
verdict $? "a source that fails closes the throttle: $(tail -n 1 "$work/err")"

# ---- Files that are not calibrations

expected="a channel's raw values at -100, 0 and +100 % are expected, such as CH1 172 992 1811, with each channel of CH1 to CH16 at most once"
while IFS='|' read -r text message; do
  printf '%b' "$text" >"$work/bad.txt"
  ! joystick sim --calibration "$work/bad.txt" && [ "$(cat "$work/err")" = "sbus joystick: $work/bad.txt$(eval echo "\"$message\"")" ] || { cat "$work/err"; false; }
  verdict $? "joystick --calibration rejects \"$text\""
done <<'END'
|: no channels; sbus calibrate writes such a file
# CH1 172 992 1811\n|: no channels; sbus calibrate writes such a file
CH1 172 992 1811\nCH2 172 992\n|:2: $expected
CH17 172 992 1811|:1: $expected
CH0 172 992 1811|:1: $expected
CH1 172 992 2048|:1: $expected
CH1 172 1811 992|:1: $expected
CH1 0 0 0|:1: $expected
CH1 172 992 1811 8|:1: $expected
CH1 172 992 -1811|:1: $expected
CH1 172 992 1811\n\nCH1 172 992 1811|:3: $expected
frame 0F|:1: $expected
END
! joystick sim --calibration "$work/none.txt" && [ "$(cat "$work/err")" = "sbus joystick: $work/none.txt: No such file or directory; sbus calibrate writes such a file" ]
verdict $? "joystick --calibration says that a file does not exist"
! joystick sim --calibration "$work" && grep -q 'sbus calibrate writes' "$work/err"
verdict $? "joystick --calibration rejects a folder: $(cat "$work/err")"

# ---- Errors of /dev/uinput

while IFS='|' read -r number message; do
  export UINPUT_ERRNO=$number
  ! joystick sim && [ "$(cat "$work/err")" = "sbus joystick: /dev/uinput: $message" ] || { cat "$work/err"; false; }
  verdict $? "joystick says: $message"
done <<END
13|Permission denied. This lets the user who is logged in at the PC use it: echo '$(cat ../extras/cli/60-sbus-uinput.rules)' | sudo tee /etc/udev/rules.d/60-sbus-uinput.rules; sudo udevadm control --reload; sudo udevadm trigger --name-match=uinput
2|No such file or directory. Load the kernel's module: sudo modprobe uinput
19|No such device. Load the kernel's module: sudo modprobe uinput
24|Too many open files
END
unset UINPUT_ERRNO
# shellcheck disable=SC2046  # they are several
g++ -std=c++17 -fsanitize=address -I../extras -I../src -c ../extras/cli/GameController.cpp -o "$work/none.o" &&
  g++ -fsanitize=address $(find "${SBUS%/*}/objects" -name '*.o' ! -name GameController.o) "$work/none.o" \
    -lserialport -lncursesw -larchive -o "$work/sbus" &&
  ! "$work/sbus" joystick sim 2>"$work/err" && grep -qx 'sbus joystick: this sbus was built without libevdev. On Linux install libevdev-dev and pkg-config, and build it again: make sbus' "$work/err" &&
  "$work/sbus" csv recordings/paper.txt >"$work/rows" && [ -s "$work/rows" ]
verdict $? "sbus builds without libevdev, and joystick then says what to install"

# ---- The kernel's /dev/uinput

if ! [ -c /dev/uinput ] || ! [ -w /dev/uinput ]; then
  echo "skipped sbus: joystick at the kernel's own /dev/uinput: there is none here that may be opened"
  exit
fi
record_for 3 ch1=1811,ch3=1811,ch9=1811
player send "$lasting"
"$SBUS" joystick "$terminal" 2>"$work/err" &
reader=$!
until_true grep -q . "$work/err"
python3 - "$(sed -n 's/: a game controller.*//p' "$work/err")" <<'END'
import fcntl, struct, sys, time
time.sleep(1)  # udev gives it its rights, and the frames come
with open(sys.argv[1], "rb") as device:
    axis = lambda code: struct.unpack("6i", fcntl.ioctl(device, 0x80184540 + code, bytes(24)))[:3]  # EVIOCGABS
    keys = fcntl.ioctl(device, 0x80604518, bytes(96))  # EVIOCGKEY
    sys.exit([axis(code) for code in (0, 1, 2)] != [(1000, -1000, 1000), (0, -1000, 1000), (1000, -1000, 1000)]
             or not keys[0x130 // 8] & 1)
END
verdict $? "joystick works with the kernel's /dev/uinput: $(cat "$work/err")"
kill $reader "$player"
wait $reader "$player"

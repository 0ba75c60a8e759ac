#!/bin/sh
# Tests what `sbus calibrate` prints and writes, and what `sbus joystick` reads of that; says "ok ..." or "FAILED ...".
set -u
cd "$(dirname "$0")/.." || exit 1
. tool/common.sh

# ---- The simulated transmitter: CH2 is reversed, the sticks rest at 1000, 985 and 992, CH5 and CH6 are switches

# Of a source without time of its own 100 keys are read a millisecond: Enter comes after 15 s of the line, or 12.5 s.
{ head -c 1500000 /dev/zero; echo; } >"$work/enter"
{ head -c 1250000 /dev/zero; echo; } >"$work/early"
: >"$work/none"
steps='1 of 3: Move all sticks, sliders and switches to all their ends. Then centre the sticks, throttle low, let go, and press Enter.
2 of 3: Hands off.
3 of 3: Push both sticks up and right, and hold them there.
CH1 is where it rested: push it up or right.
CH1 was not held: hold it up or right until told.'
table='# sbus calibrate: raw values at -100, 0 and +100 %
CH1 172 1000 1811
CH2 1811 985 172
CH3 172 992 1811
CH4 172 992 1811
CH5 172 992 1811
CH6 172 992 1811'
while IFS='|' read -r keys words options; do
  rm -f "$work/file"
  # shellcheck disable=SC2086  # they are words
  "$SBUS" calibrate sim:calibration${words:+,$words} --simulated-time $options -o "$work/file" <"$work/$keys" 2>"$work/err" &&
    grep -v 'still: let go' "$work/err" >"$work/steps" && printf '%s\n%s:\n%s\n' "$steps" "$work/file" "$table" | cmp - "$work/steps" && echo "$table" | cmp - "$work/file"
  verdict $? "calibrate sim:$words $options, with Enter as in $keys, announces each step and finds the ranges of CH1 to CH6"
done <<'END'
enter||
enter|noise=50|
enter|32|
early||
END
grep -qx 'CH[1-4] did not stand still: let go of it\.' "$work/err"
verdict $? "after Enter while the sticks still move, calibrate waits until they rest"

# ---- Sticks like real ones: their ends last for 40 ms, values jitter by 2, CH1, CH2 and CH4 rest off 992, CH2 and CH3 are
# ---- reversed, CH16 is a link quality that never rests, three frames that are marked lost bring nonsense twice a second; the adapter is unplugged, the radio is off

moves() {  # STEP: starts a player of these moves, at the end of the adapter's cable
  awk -v step="$1" '
    function jitter() { return int(5 * rand()) - 2 }
    BEGIN {
      srand(20181)
      print "time,ch1,ch2,ch3,ch4,ch5,ch6,ch16,lostframe,failsafe"
      for (i = 0; i < 6000; i++) {
        lost = (i % 50 > 46)
        wave = sin(i / 15)
        wave = step != "move" ? 0 : (wave > 0.99) ? 1 : (wave < -0.99) ? -1 : wave
        x = step == "push" ? 1 : step == "failsafe" ? 0.5 : wave
        throttle = step == "rest" ? 1811 : 992 - 819 * x
        printf "%.2f,%d,%d,%d,%d,%d,%d,%d,%d,%d\n", i / 100, 1010 + 790 * x + jitter(), 980 - 800 * x + jitter(), throttle + jitter(),
          lost ? 2047 : 992 + 700 * x + jitter(), step == "move" && int(i / 50) % 2 ? 1811 : 172, 992 + jitter(), 200 + 1500 * rand(), lost, (step == "failsafe")
      }
    }' >"$work/$1.csv"
  player send "$work/$1.csv"
  ln -sf "$terminal" "$work/adapter"
}
unplug() { kill "$player" && wait "$player"; }
says() { until_true grep -q "$1" "$work/err"; }
mkfifo "$work/keys"
moves move
timeout 60 "$SBUS" calibrate "$work/adapter" -o "$work/radio.txt" <"$work/keys" 2>"$work/err" &
calibrating=$!
exec 3>"$work/keys"
echo >&3 && says 'CH1 .*Then press Enter\.$'
verdict $? "Enter before the sticks have moved does not end the step: $(tail -n 1 "$work/err")"
sleep 3
echo >&3 && says '^2 of 3'
unplug
says '^The link is lost'
verdict $? "an adapter unplugged while the sticks rest is reported as a lost link"
moves failsafe
sleep 1.5
[ "$(tail -n 1 "$work/err")" = "$work/adapter: the port is back" ]
verdict $? "failsafe values do not count as resting sticks"
unplug
moves rest
says '^3 of 3' && unplug
moves push
wait $calibrating && exec 3>&- && unplug
awk '
  function near(value, wanted) { return value >= wanted - 2 && value <= wanted + 2 }
  NR == 2 { good += $1 == "CH1" && near($2, 220) && near($3, 1010) && near($4, 1800) }
  NR == 3 { good += $1 == "CH2" && near($2, 1780) && near($3, 980) && near($4, 180) }
  NR == 4 { good += $1 == "CH3" && near($2, 1811) && near($3, 992) && near($4, 173) }
  NR == 5 { good += $1 == "CH4" && near($2, 292) && near($3, 992) && near($4, 1692) }
  NR == 6 { good += $0 == "CH5 172 992 1811" }
  END { exit NR != 6 || good != 5 }' "$work/radio.txt" || { cat "$work/radio.txt" "$work/err"; false; }
verdict $? "centre and ends are found to within 2: $(sed 1d "$work/radio.txt" | paste -sd ,)"
rm "$work/adapter"  # a library has no links, not even in build/

# ---- An error leaves no file behind, and no existing file is lost

while IFS='|' read -r keys source options message; do
  rm -f "$work/file"
  # shellcheck disable=SC2086  # they are words
  ! "$SBUS" calibrate "$source" --simulated-time $options -o "$work/file" <"$work/$keys" 2>"$work/err" &&
    [ "$(tail -n 1 "$work/err")" = "sbus calibrate: $message" ] && [ ! -e "$work/file" ]
  verdict $? "calibrate $source $options says: $message"
done <<'END'
enter|sim:calibration|--seconds 20|nothing was written, because the third step was not completed: CH1 is where it rested: push it up or right
enter|sim:silent|--seconds 14|nothing was written, because the third step was not completed: CH1 was not seen: switch the radio on
none|sim:calibration|--seconds 20|standard input has ended, so Enter cannot be pressed; run it in a terminal
END

#!/bin/sh
# Writes the recordings that verdicts/LINES names into a folder, three seconds each: as long as a round of the sketch
# Diagnose and more.   lines.sh FOLDER
set -eu
folder=$1

# lines KIND: prints a line of S.Bus as a recording
lines() {
  awk -v kind="$1" 'BEGIN {
    seed = 20181
    srand(seed)
    print "# verdicts/lines.sh, seed " seed
    print kind == "fast" ? "# 200000 baud, 8E2, inverted" : "# 100000 baud, 8E2, inverted"
    neutral = "F8 C0 07 3E F0 81 0F 7C E0 03 1F"  # eight channels of 992
    sixteen = "0F E5 03 1F " neutral " F8 C0 07 3E F0 81 0F 7C"
    twentyfour = "0F E5 03 1F " neutral " " neutral " F8 C0 07 3E F0 81 0F 7C"
    zero = "00 00 00 00 00 00 00 00 00 00 00"  # eight channels
    futaba = "0F E9 03 20 A8 01 08 16 50 03 10 80 00 04 20 00 01 08 40 00 02 10 80 00"
    split("04 14 24 34", ends, " ")
    periodUs = kind ~ /^(sbus2|r7003sb|other)$/ ? 15000 : 9000
    silenceUs = kind == "gap" ? 10000000 : 0
    if (match(kind, /^[0-9]+ms/)) periodUs = 1000 * substr(kind, 1, RLENGTH - 2)
    if (kind == "spread") periodUs = 14000
    if (kind == "idle") periodUs = 36000
    if (kind == "8n2") gsub(/0F|03|C0|F0|81/, "&!", sixteen)  # what has an even number of ones
    for (us = 120; us < silenceUs + 3000000 && kind !~ /^(noise|bad)$/; us += periodUs) {
      count++
      if (kind == "sbus2") {  # a sensor answers each 04
        print us, futaba, ends[count % 4 + 1]
        if (count % 4 == 0) print us + 5000, "03 C0 2E"
      } else if (kind == "r7003sb") print us, futaba, "08 00 03 C0 33 00"
      else if (kind == "other") print us, "55 AA 01 02 03 04 05 06"
      else if ((kind == "ends" && us > 1500000) || (kind == "begins" && us < 1500000)) print us, "55 AA 01 02 03 04 05 06 55 AA 01 02 03 04 05 06"
      else if (kind == "zeros-after" && us > 1500000) print us, "00 00 00", zero, zero
      else if (kind == "ibus") print us, "20 40 DC 05 DC 05 DC 05 DC 05 DC 05 DC 05 DC 05 DC 05 DC 05 DC 05 DC 05 DC 05 DC 05 DC 05 51 F3"
      else if (kind == "crsf") print us, "C8 18 16 E0 03 DF F7 C0 C7 0A F0 81 0F 7C E0 03 1F F8 C0 07 3E F0 81 0F 7C 41"
      else if (kind == "24" || (kind == "16to24" && us > 1500000) || (kind == "24to16" && us < 300000)) print us, twentyfour, "00 00"
      else if (kind == "failsafe") print us, sixteen, "0C 00"
      else if (kind == "no-pulses") print us, "0F", zero, zero, "00 00"
      else if (kind == "four-zero") print us, "0F 00 00 00 00 00 00 C0 07 3E F0 81 0F 7C E0 03 1F F8 C0 07 3E F0 81 00 00"
      else if (kind == "zero-failsafe") print us, "0F", zero, zero, "08 00"
      else if (kind == "no-radio") print us, sixteen, "04 00"
      else if (kind == "spread") for (i = 0; i < 25; i++) print us + 200 * i, substr(sixteen " 00 00", 1 + 3 * i, 2)
      else if (kind == "paused") print us, substr(sixteen, 1, 35) "\n" us + 2140, substr(sixteen, 37), "00 00"
      else if (kind == "idle") print us, "B0! 8C! 0D! 36! BF C8 0A F0 81 0F 7C E0 03 1F F8 C0 07 3E F0 81 0F 7C 00 00 00!"
      else if (kind == "8n2") print us, sixteen, "00! 00!"
      else if (kind == "80ms-missing" && count % 10 == 4) continue
      else if (kind == "flipped" && count % 29 == 4) print us, "2F" substr(sixteen, 3), "00 00"
      else if (kind == "header-f0") print us, "F0" substr(sixteen, 3), "00 00"
      else if (kind == "header-f0-zeros") print us, "F0 E5 03 1F F8 C0 07 3E", zero, "00 00 00 00 00 00"
      else if (kind == "end-55") print us, sixteen, "00 55"
      else if (kind == "24-bytes") print us, sixteen, "00"
      else if (kind == "23-bytes") print us, sixteen
      else if (kind == "flags-high") print us, sixteen, (count % 30 < 10 ? "30 00" : "00 00")
      else if (kind == "dbus") print us, "00 C4 6F 88 A9 D8 00 00 00 00 00 00 00 00 00 00 00 04"
      else if (kind == "seven-bits") print us, "0F 65 03 1F 78 40 07 3E 70 01 0F 7C 60 03 1F 78 40 07 3E 70 01 0F 7C 00 00"
      else if (kind == "in-turn") print us, sixteen, (int(count * 0.45) > int((count - 1) * 0.45) ? "00 00" : "04 00")  # 50 of 111
      else if (kind == "at-random") print us, sixteen, (rand() < 0.35 ? "04 00" : "00 00")
      else if (kind == "jumps" && count % 70 == 35) print us, "0F E5 03 1F F8 C1" substr(sixteen, 18), "00 00"
      else if (kind == "chance" && count % 80 != 40) {  # frames come by chance
        printf "%d", us
        for (i = 0; i < 25; i++) printf " %02X", int(rand() * 256)
        print ""
      } else if (kind == "half") print us, substr(sixteen, 1, 3 * 12)
      else if (kind != "cut" || count < 4 || us > 2991000) print us, sixteen, "00 00"  # cut for all but three frames
      if (count == 167) us += silenceUs
    }
    for (us = 120; us < 3000000 && kind ~ /^(noise|bad)$/; us += 120 + int(rand() * 4000)) {
      printf "%d %02X%s\n", us, int(rand() * 256), kind == "bad" || rand() < 0.5 ? "!" : ""
    }
  }'
}

# at_adapter: prints the line as an FTDI adapter brings it, which hands bytes over every 16 ms, in packets of 62
at_adapter() {
  awk '
    function packet(us,  i, first) {
      first = us - 120 * (count - 1)
      if (first < next_) first = next_
      for (i = 0; i < count; i++) printf "%s%s", i == 0 ? first "~18000 " : " ", bytes[i]
      if (count > 0) print ""
      next_ = first + 120 * count
      count = 0
    }
    /^#/ { print; next }
    {
      for (field = 2; field <= NF; field++) {
        us = $1 + 120 * (field - 2)
        for (; timer < us; timer += 16000) packet(timer)
        bytes[count++] = $field
        if (count == 62) packet(us)
      }
    }
    END { packet(timer) }'
}

for kind in 80ms 80ms-missing 120ms 200ms spread ends zeros-after begins paused idle 8n2 flipped fast gap ibus crsf failsafe no-pulses four-zero zero-failsafe no-radio sbus2 r7003sb other header-f0 header-f0-zeros end-55 24-bytes 23-bytes flags-high dbus seven-bits in-turn at-random jumps 24 16to24 24to16 half chance cut noise bad good; do
  lines $kind >"$folder/$kind.txt"
done
head -n 3 "$folder/good.txt" >"$folder/one.txt"
head -n 4 "$folder/good.txt" >"$folder/two.txt"
for kind in good 24 24to16 sbus2; do
  at_adapter <"$folder/$kind.txt" >"$folder/adapter-$kind.txt"
done

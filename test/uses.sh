#!/bin/sh
# Checks that every public function of the headers that sketches include is called by a sketch that the tests build (an
# example, or a sketch of README.md and the pages), and that every word of keywords.txt is in the library and too special for
# other sketches, which the IDE would also colour. Says "ok ..." or "FAILED ..." of each.
set -u
cd "$(dirname "$0")/.." || exit 1
# Takes what is between ```cpp and ``` and has a loop(), as golden.sh does.
sketches=$(cat examples/*/*.ino examples/*/*.h; awk '
  /^```$/ && inside { inside = 0; if (text ~ /void loop/) printf "%s", text }
  inside { text = text $0 "\n" }
  /^```cpp$/ { inside = 1; text = "" }' README.md extras/docs/[!R]*.md)
code=$(echo "$sketches" | sed 's,//.*,,')

printf '\nuses: every public function is used by a sketch; keywords\n'
cd src || exit 1
functions=$(sed -nE '/@cond/,/@endcond/d; /^ (protected|private):/,/^};/d; /^ *(return|friend|explicit) /d
  s,^ {0\,2}[A-Za-z][A-Za-z0-9_: ]* [*&]?([a-zA-Z]+)\(.*,\1,p' \
  DecodeSBus.h DecodeSBus32.h DecodeSBusBackground.h DecodeSBusTelemetry.h DecodeSBusDiagnosis.h SBus2Sensor.h EncodeSBus.h SBusBoard.h sbus/Calibration.h sbus/Calibrator.h sbus/Diagnosis.h sbus/LinkQuality.h sbus/ReceiverChoice.h sbus/Scaling.h sbus/Trainer.h | sort -u)
for name in $functions; do
  if echo "$code" | grep -qE "\b$name\("; then
    echo "ok uses: $name()"
  else
    echo "FAILED uses: no sketch uses $name()"
  fi
done

# What differs between cores stands in port/Core.h.
chips=$(grep -lE '^#.*\b(__AVR__|ARDUINO_ARCH_[A-Za-z0-9]+|ESP32|ESP8266|CORE_TEENSY|__IMXRT1062__|PICO_SDK_VERSION_MAJOR)\b' ./*.h ./*.cpp */*.h */*.cpp */*/*.h */*/*.cpp |
  grep -vxE '\./SBusBoard\.h|port/Core\.h|sbus/Text\.h')
if [ -z "$chips" ]; then echo "ok uses: port/Core.h alone names cores"; else echo "FAILED uses: these name a core: $chips"; fi

# Two words joined are special enough; begin, high or None are not.
special='[a-z0-9][A-Z]'
while IFS='	' read -r name kind; do
  case $kind in KEYWORD2) place="\b$name\(" ;; *) place="\b$name\b" ;; esac
  if ! echo "$name" | grep -q "$special"; then
    echo "FAILED keywords: $name is an ordinary word: other people's sketches have it"
  elif ! grep -qE "$place" ./*.h port/*.h sbus*/*.h; then
    echo "FAILED keywords: $name is not in the library"
  else
    echo "ok keywords: $name"
  fi
done <<END
$(grep '	' ../keywords.txt)
END
for name in $(echo "$functions" | grep "$special"); do
  grep -qx "$name	KEYWORD2" ../keywords.txt || echo "FAILED keywords: $name() is missing"
done
# Types that a sketch writes; DecodeSBusOf and the like are what they are made of.
types=$(sed -nE '/@cond/,/@endcond/d; s,^(class|struct|enum class|using) ([A-Za-z0-9]+)( [:={].*| : .*)$,\2,p' \
  DecodeSBus*.h EncodeSBus.h SBus2Sensor.h SBusPin.h sbus/Calibration.h sbus/Calibrator.h sbus/Diagnosis.h sbus/LinkQuality.h sbus/Link.h \
  sbus2/Sensors.h | grep -vE '(DecodeSBus|Decode.*[^d]|Encode.*)Of$' | grep "$special" | sort -u)
for name in $types; do
  grep -qx "$name	KEYWORD1" ../keywords.txt || echo "FAILED keywords: $name is missing"
done

#!/bin/sh
# Prints how much flash and RAM the library and the examples take: a table in Markdown.
#   ATmega2560    avr-g++ -Os; an example is a whole program, as the IDE links it
#   Cortex-M0+    arm-none-eabi-g++ -Os, for the Grasshopper; without its core, which is no part of this repository
# A piece of the library is what a program takes more with it than without. What the C library and the compiler's own
# add is not counted: division, memmove(), floating point; but it is for the whole programs, and in the rows of scaling.
# Fails if the decoder takes more than its bounds, which hold for these compilers.
# BUILD: an absolute folder for what is built; the examples for the ATmega2560 are there already (boards/avr/build.mk).
set -eu
cd "$(dirname "$0")"
root=$(cd ../.. && pwd)
host=$root/extras/host
avr_core=/usr/share/arduino/hardware/arduino/avr
out=$BUILD/size

common="-Os -std=gnu++11 -fno-exceptions -fno-rtti -fno-threadsafe-statics -ffunction-sections -fdata-sections"
# What a core calls, by the names that C and C++ give it.
roots=$(for name in setup loop serialEvent1; do echo ",--undefined=$name,--undefined=_Z${#name}${name}v"; done | tr -d '\n')
linking="-nostdlib -Wl,--gc-sections,--entry=0$roots"

specs=$("$root/extras/setup/arm-specs.sh")

# shellcheck disable=SC2086  # the flags are words
avr() {
  avr-g++ -mmcu=atmega2560 -DF_CPU=16000000L -DARDUINO=10819 -DARDUINO_ARCH_AVR $common -w \
    -I$avr_core/cores/arduino -I$avr_core/variants/mega -I.. -I"$root/src" -I"$host/standin" "$@"
}

# shellcheck disable=SC2086
arm() {
  arm-none-eabi-g++ $specs -mcpu=cortex-m0plus -mthumb -DARDUINO=10819 $common \
    -I"$host/arduino" -I../boards/cores/stm32l0 -include stm32l0_dma.h -I.. -I"$root/src" -I"$host/standin" "$@"
}

# program CHIP PROGRAM LIBRARIES WHAT...: links WHAT, a source and its flags, with what is needed of our objects and LIBRARIES
#
# Functions that the core and the C library would bring are empty here, except those that avr-ld's script defines. GNU ld
# 2.44 for ARM rejects undefined functions.
# shellcheck disable=SC2086
program() {
  chip=$1
  program=$2
  needed=$3
  shift 3
  $chip -r -nostdlib "$out/$chip"/*.o "$@" -x none $needed -o "$program.o"
  undefined "$program.o" | while read -r symbol; do
    [ "$chip" = avr ] || echo ".thumb_func"
    printf '.global %s\n.type %s, %%function\n%s:\n' "$symbol" "$symbol" "$symbol"
  done >"$program.s"
  $chip $linking "$out/$chip"/*.o "$@" -x assembler "$program.s" -x none $needed -o "$program"
}

undefined() { case $1 in */avr-*) avr-nm -u "$1" ;; *) arm-none-eabi-nm -u "$1" ;; esac | sed -n '/__data_load/d;s/^ *U //p'; }

# flash PROGRAM, ram PROGRAM
sections() { case $1 in */avr-* | */mega/*) avr-size -A "$1" ;; *) arm-none-eabi-size -A "$1" ;; esac; }
flash() { sections "$1" | awk '/^\.(text|rodata|data|init_array|fini_array|ARM.ex)/ { sum += $2 } END { print sum + 0 }'; }
ram() { sections "$1" | awk '/^\.(data|bss|noinit)/ { sum += $2 } END { print sum + 0 }'; }

for chip in avr arm; do
  rm -rf "${out:?}/$chip"
  mkdir -p "$out/$chip"
  for source in "$root"/src/*.cpp "$root"/src/sbus*/*.cpp; do
    $chip -c "$source" -o "$out/$chip/$(basename "$source" .cpp).o"
  done
  program $chip "$out/$chip-NOTHING" "" -DUSE_NOTHING Uses.cpp
done

# Only an AVR has an SBusPin.
pin() {
  program avr "$out/avr-PIN" "" -DUSE_PIN Uses.cpp "$root/src/port/SBusPin.cpp"
  echo "| \`DecodeSBus\` on an \`SBusPin\`: the same | $(($(flash "$out/avr-PIN") - $(flash "$out/avr-NOTHING"))) | $(($(ram "$out/avr-PIN") - $(ram "$out/avr-NOTHING"))) | | |"
}

failed=0
# piece USE WHAT [LIBRARIES [MOST...]]: MOST are the bounds of the row's four numbers
piece() {
  use=$1 row="| $2" libraries=${3:-}
  shift $(($# < 3 ? $# : 3))
  for chip in avr arm; do
    program $chip "$out/$chip-$use" "$libraries" "-DUSE_$use" Uses.cpp
    for what in flash ram; do
      bytes=$(($($what "$out/$chip-$use") - $($what "$out/$chip-NOTHING")))
      row="$row | $bytes"
      if [ $# -gt 0 ]; then
        [ "$bytes" -le "$1" ] || { echo "FAILED size: USE_$use: $what of $chip: $bytes bytes, at most $1" >&2; failed=1; }
        shift
      fi
    done
  done
  echo "$row |"
}

example() {  # NAME
  mega=$BUILD/avr/mega/$1.elf
  program arm "$out/arm-$1" "" -x c++ -include Arduino.h "../../examples/$1/$1.ino"
  echo "| examples/$1 | $(flash "$mega") | $(ram "$mega") | $(flash "$out/arm-$1") | $(ram "$out/arm-$1") |"
}

compilers="avr-g++ $(avr-g++ -dumpfullversion -dumpversion), arm-none-eabi-g++ $(arm-none-eabi-g++ -dumpfullversion -dumpversion)"
echo "$compilers"
echo
case $compilers in "avr-g++ 5.4.0, arm-none-eabi-g++ 12.2.1") most="6502 238 4902 260" ;; *) most= ;; esac
echo "| bytes | ATmega2560: flash | RAM | Cortex-M0+: flash | RAM |"
echo "| --- | --- | --- | --- | --- |"
piece PAPERS "the baseline: begin, parse"
# shellcheck disable=SC2086  # the bounds are words
piece DECODER "\`DecodeSBus\`: begin, parse, decode, SBusFrameOk" "" $most
pin
piece EXTRA "\`DecodeSBus32\`: the same, decodeExtraChannels"
piece ALL_OF_DECODER "\`DecodeSBus\`, all methods"
piece ENCODER "\`EncodeSBus\`: begin, write"
piece NORMALIZED "\`sbus::toNormalized()\` alone, with the compiler's division" -lgcc
piece CALIBRATOR "\`sbus::Calibrator\`, all but \`text()\`, and the struct"
piece CHOICE "\`sbus::ReceiverChoice<2>\`: choose; without \`LinkQuality\`"
for sketch in ../../examples/*/; do
  example "$(basename "$sketch")"
done
exit $failed

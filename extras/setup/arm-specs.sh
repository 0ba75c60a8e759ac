#!/bin/sh
# Prints what arm-none-eabi-g++ needs to find a C library: nothing with newlib, a flag where there is only picolibc.
case $(arm-none-eabi-g++ -print-file-name=rdimon.specs)$(arm-none-eabi-g++ -print-file-name=picolibc.specs) in
  rdimon.specs/*) echo -specs=picolibc.specs ;;
esac

#!/bin/sh
# Prints what arm-none-eabi-g++ needs to find a C library: nothing with newlib, a flag with picolibc.
case $(arm-none-eabi-g++ -print-file-name=rdimon.specs) in
  */*) ;;
  *) echo -specs=picolibc.specs ;;
esac

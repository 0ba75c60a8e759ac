# How a program for QEMU's microbit is linked: newlib's start-up code and linker script, with the vectors in flash, and the data
# at once where they belong, in RAM. (A unit program takes 0.1 MB of flash.)
MICROBIT := -specs=rdimon.specs -Wl,--gc-sections,--undefined=vectors,--section-start=.vectors=0,-Tdata=0x20000000

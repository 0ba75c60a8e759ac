// The costliest attacks that searches of millions of tries have found, each on another receiver. Bytes and calls that
// could be left out without a lower cost were left out.
#pragma once

constexpr const char *KnownAttacks[] = {
    "+3720 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 00 0F 0F 0F 0F\n"
    "+3840 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F\n"
    "+1080 0F 0F 0F 0F 08 0F 0F\n"
    "+4000 2F 0F 00 00\n"
    "+1800 0F 0F 04 0F 0F 0F 04 0F 04 0F 0F 00 0F\n"
    "+360 0F\n"
    "+840 04 0F 0F 0F 0F\n"
    "+1800 0F 0F 08 0F 00 04 0F 0F 08 04 0F 0F 04\n"
    "+7920 0F 04 08 00 08 04 0F 08 08 0F 00 00 0F 00 08 04 0F 04 0F 0F 00 08 00 04 0F 0F 0F 04 0F 0F 0F 0F 0F "
    "04 0F 08 0F 0F 0F 0F 08 0F 08 04 0F 0F 00 00 08 04 0F 0F 08 04 2F 04 0F 0F 08 0F 04 00 0F 0F\n",
    "+4000 0F 0F 0F 0F 0F 0F 0F 0F\n"
    "+4800 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F "
    "0F 0F 0F 0F 00\n"
    "+4000 0F 0F 0F 0F\n"
    "+4000 0F 0F 0F 0F 0F 0F\n"
    "+1800 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F 0F\n"
    "+600 0F 04 0F\n"
    "+4000 2F 0F 0F\n"
    "+1800 00 0F 0F 08 0F 0F 0F 0F 08 0F 0F 08 0F\n"
    "+360 0F\n"
    "+840 0F 0F 04 0F 00\n"
    "+7920 00 04 00 00 0F 0F 08 0F 0F 04 08 08 0F 0F 08 0F 0F 04 34 0F 0F 0F 04 00 04 0F 0F 0F 04 08 00 08 08 "
    "0F 0F 0F 08 0F 0F 04 34 00 0F 08 04 34 00 0F 0F 04 08 00 0F 0F 0F 0F 0F 08 0F 0F 0F 04 00 0F\n",
};

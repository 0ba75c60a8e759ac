// github.com/raspberrypi/pico-sdk 2.2.0 (a1438df), as far as the library calls it.
#pragma once

unsigned get_core_num();

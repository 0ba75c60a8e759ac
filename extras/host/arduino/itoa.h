#pragma once

// Write a number to `text`, in a base of 2..36 with lower-case digits; only base ten has a minus. They return `text`,
// or null for another base. As on the board a long has 32 bits: higher bits are cut off.
char *itoa(int number, char *text, int base);
char *utoa(unsigned number, char *text, int base);
char *ltoa(long number, char *text, int base);
char *ultoa(unsigned long number, char *text, int base);

#pragma once

// Writes `value` to `text` with `precision` decimals, at least |width| characters wide, on the left if `width` is
// negative. Returns `text`, which must be large enough: as on the board, this is not checked.
char *dtostrf(double value, signed char width, unsigned char precision, char *text);

// Splits a row of CSV into fields, and classifies them: title, unit, level, voltage or time.
#pragma once

#include <initializer_list>
#include <string_view>
#include <vector>

namespace line {

using Fields = std::vector<std::string_view>;

constexpr std::string_view Separators = ";\t,";  // with another separator, a comma is a decimal point

// Sets the fields of a row. A separator at its end does not begin another field.
void splitRow(std::string_view row, char separator, Fields &fields);

// Returns true if the line is a comment. A single # is a column's title.
bool isComment(std::string_view line);

// Returns true if the field is 0, 1 or unknown.
bool isLogic(std::string_view field);

// Returns true if each field is a number or empty, and at least one is a number.
bool isRow(const Fields &fields);

// Returns true if the fields are names. All but the first may be numbers of channels.
bool isTitles(const Fields &fields);

// Returns true if the field is a unit, as oscilloscopes write it below a channel's name.
bool isUnit(std::string_view field);

// Returns the unit of time in a title, in ns; by default a second.
double unitOf(std::string_view title);

// Returns true if `text` has one of these words, in any case. A micro sign in any encoding counts as u.
bool hasWord(std::string_view text, std::initializer_list<std::string_view> words);

// Takes an infinity sign, perhaps with a minus, off the front: PicoScope writes it for a voltage beyond its range. Any
// character beyond ASCII counts as one. Returns false without one.
bool takeInfinity(const char *&at, const char *end, double &volts);

}  // namespace line

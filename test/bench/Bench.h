// The tables of the bench: each is printed, and compared with its bounds.
#pragma once

#include <cstdint>
#include <string>

// Says "ok bench: ..." or "FAILED bench: ...".
void verdict(bool good, const std::string &what);

// `most` holds for GCC 12, whose figures are in measured.md; another compiler may take a quarter more. A cost of 0
// means that the code did not do its work.
void atMost(const std::string &what, uint32_t found, uint32_t most);

void printFrames();
void checkFrames();

void printLongestCall();
void checkLongestCall();

// What is measured, table by table: each is printed, and held to its bounds.
#pragma once

#include <cstdint>
#include <string>

// Says "ok bench: ..." or "FAILED bench: ...".
void verdict(bool good, const std::string &what);

// A cost of 0 is one of what did not do its work.
void atMost(const std::string &what, uint32_t found, uint32_t most);

void printFrames();
void checkFrames();

void printUnpacking();

// Lines that cost a receiver more than a clean one.
void printBadLines();
void checkBadLines();

void printLongestCall();
void checkLongestCall();

void printValues();
void checkValues();

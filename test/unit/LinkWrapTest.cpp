// The link across the wraps of micros(), after 71 minutes, and of millis(), after 49 days.
#include <doctest/doctest.h>

#include "LinkChecks.h"

TEST_CASE("frameAge is right for the 71 minutes that micros() lasts, and wraps then, as it says") {
  OpenBoard board;
  board.frame(PaperLow.bytes);
  board.wait(1 * Hour);
  CHECK(board.sbus.frameAge() == 1 * Hour / Ms);
  board.wait(MicrosWrap - 1 * Hour - 1 * Ms);
  CHECK(board.sbus.frameAge() == MicrosWrap / Ms - 1);
  board.wait(6 * Ms);
  CHECK(board.sbus.frameAge() == 5);
}

TEST_CASE("frames flow across the wraps of micros() and millis(), each delivered, the link ok all the time") {
  for (const uint64_t wrap : {MicrosWrap, MillisWrap}) {
    for (const uint64_t stepUs : {7 * Ms, 14 * Ms + 1}) {
      CAPTURE(wrap);
      CAPTURE(stepUs);
      fakeMicros = wrap - 40 * stepUs - 11;
      OpenBoard board;
      for (uint32_t frames = 1; frames <= 80; frames++) {
        CAPTURE(frames);
        board.frame(frames % 2 != 0 ? PaperLow.bytes : Neutral.bytes);
        CHECK(board.sbus.counters().frames == frames);
        CHECK(board.sbus.frameAge() == 0);
        for (uint64_t waited = 3 * Ms; waited < stepUs; waited += 1 * Ms) {
          checkState(board, LinkState::Ok);
          CHECK(board.sbus.frameAge() == (waited - 3 * Ms) / Ms);
          board.wait(1 * Ms);
        }
      }
      CHECK(board.sbus.counters().period > stepUs - 2 * Ms);
      CHECK(board.sbus.counters().period < stepUs + 2 * Ms);
    }
  }
}

TEST_CASE("a frame that came just before a wrap becomes stale behind it, at its time") {
  for (const uint64_t wrap : {MicrosWrap, MillisWrap}) {
    for (const uint64_t before : {1 * Ms, 50 * Ms, 99 * Ms}) {
      CAPTURE(wrap);
      CAPTURE(before);
      fakeMicros = wrap - before - 3 * Ms;
      OpenBoard board;
      board.frame(PaperLow.bytes);
      board.wait(99 * Ms);
      checkState(board, LinkState::Ok);
      CHECK(board.sbus.frameAge() == 99);
      board.wait(1 * Ms);
      checkState(board, LinkState::Stale);
      CHECK(board.sbus.frameAge() == 100);
    }
  }
}

TEST_CASE("a link silent for exactly a wrap of micros(), and a little, is stale if the sketch has asked once in between") {
  for (const uint64_t more : {uint64_t{0}, 1 * Ms, 50 * Ms, 99 * Ms}) {
    for (const uint64_t asked : {100 * Ms, 20 * 60 * Second, 1 * Hour}) {
      CAPTURE(more);
      CAPTURE(asked);
      fakeMicros = 3 * Second;
      OpenBoard board;
      board.frame(PaperLow.bytes);
      board.wait(asked);
      CHECK_FALSE(board.sbus.SBusFrameOk());
      board.wait(MicrosWrap - asked + more);
      CHECK_FALSE(board.sbus.SBusFrameOk());
      checkState(board, LinkState::Stale);
    }
  }
}

TEST_CASE("a link found stale stays stale across the wraps of micros() and of millis()") {
  for (const uint64_t wrap : {MicrosWrap, MillisWrap}) {
    for (const uint64_t ask : {50 * Ms, 20 * Second}) {
      CAPTURE(wrap);
      CAPTURE(ask);
      fakeMicros = 3 * Second;
      OpenBoard board;
      board.frame(PaperLow.bytes);
      board.wait(200 * Ms);
      checkState(board, LinkState::Stale);
      board.wait(wrap - 400 * Ms);
      for (uint64_t us = 0; us < 400 * Ms; us += 50 * Ms) {
        checkState(board, LinkState::Stale);
        board.wait(50 * Ms);
      }
      board.frame(PaperHigh.bytes);
      checkState(board, LinkState::Ok);
    }
  }
}

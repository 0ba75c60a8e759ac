#include "Core.h"

#if defined(SBUS_PIN)

#include <avr/interrupt.h>
#include <util/atomic.h>

#include "../SBusPin.h"
#include "Port.h"

// What the interrupt writes.
extern "C" {
volatile uint8_t sbusPinEdges[256];
volatile uint8_t sbusPinHead;   // the next edge goes there
volatile uint16_t sbusPinLast;  // when the newest edge came
}

namespace {

const SBusPin *isOpen;
uint8_t controlA, controlB, comparator, digital;  // registers, as they were

constexpr uint8_t Comparator = _BV(ACBG) | _BV(ACI) | _BV(ACIC) | _BV(ACIS1);  // its flag: the output falls

constexpr uint8_t Untouched = 3;  // no two edges in turn are noted so, as the second interrupt comes after the first

uint8_t before(uint8_t place, uint8_t count) { return static_cast<uint8_t>(place - count); }

// What PlainEdges does, in 21 cycles an edge; a compiler's loop takes 30 to 40.
struct FastEdges {
  static void take(const uint8_t *&edges, uint8_t &count, uint8_t &before, uint8_t &time, uint8_t &bits,
                   uint8_t &level) {
    uint8_t now;
    asm("1: ld %[now], %a[edges]+\n"
        "cpi %[now], %[shortest]\n"
        "brlo 2f\n"
        "add %[now], %[time]\n"
        "brcs 2f\n"
        "movw r30, %[masks]\n"
        "add r30, %[now]\n"
        "adc r31, __zero_reg__\n"
        "lpm r30, Z\n"
        "cpi r30, %[none]\n"
        "breq 2f\n"
        "eor %[bits], r30\n"
        "com %[level]\n"
        "mov %[before], %[time]\n"
        "mov %[time], %[now]\n"
        "dec %[count]\n"
        "brne 1b\n"
        "rjmp 3f\n"
        "2: sbiw %[edges], 1\n"
        "3:\n"
        : [edges] "+x"(edges), [count] "+r"(count), [before] "+r"(before), [time] "+r"(time), [bits] "+r"(bits),
          [level] "+r"(level), [now] "=&d"(now)
        : [masks] "r"(sbus::EdgeDecoder::masks()), [shortest] "M"(sbus::EdgeDecoder::ApartMin),
          [none] "M"(sbus::EdgeDecoder::None)
        : "r30", "r31", "memory");
  }
};

// Waits for the next change of the comparator's output, with both edge detectors. (The output is high while the line is
// low.)
void await() {
  const bool isHigh = (ACSR & _BV(ACO)) != 0;
  TCCR1B = static_cast<uint8_t>(_BV(CS11) | (isHigh ? 0 : _BV(ICES1)));
  ACSR = static_cast<uint8_t>(Comparator | (isHigh ? _BV(ACIS0) : 0));
  TIFR1 = _BV(ICF1);
}

}  // namespace

// Returns the place of the oldest edge. If there were more than the buffer holds, the two places before it have been
// overwritten, too: then it is the newest of them.
inline uint8_t SBusPin::firstBefore(uint8_t head) {
  constexpr uint8_t Coming = 8;  // edges, at most, until they are taken
  if (sbusPinEdges[before(_tail, 1)] != Untouched || sbusPinEdges[before(_tail, 2)] != Untouched) {
    _decoder.lose();
    return static_cast<uint8_t>(head + Coming);
  }
  return _tail;
}

inline void SBusPin::setTail(uint8_t tail) {
  _tail = tail;
  sbusPinEdges[before(tail, 1)] = Untouched;
  sbusPinEdges[before(tail, 2)] = Untouched;
}

bool SBusPin::begin(bool inverted) {
  if (isOpen != nullptr && isOpen != this) {
    return false;
  }
  end();
  pinMode(Pin, INPUT);
  isOpen = this;
  controlA = TCCR1A;
  controlB = TCCR1B;
  comparator = ACSR;
  digital = DIDR1;
  DIDR1 |= _BV(AIN1D);
  ACSR = Comparator;
  delayMicroseconds(100);  // the reference voltage settles
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    TCCR1A = 0;
    await();
    TIFR1 = _BV(TOV1);
    sbusPinHead = 0;
    setTail(0);
    sbusPinLast = TCNT1;
    TIMSK1 |= _BV(ICIE1);
  }
  _decoder.begin(inverted);
  return true;
}

void SBusPin::end() {
  if (isOpen == this) {
    TIMSK1 &= static_cast<uint8_t>(~_BV(ICIE1));
    ACSR = comparator;
    DIDR1 = digital;
    TCCR1A = controlA;
    TCCR1B = controlB;
    isOpen = nullptr;
  }
}

int SBusPin::available() { return sbusPinHead != _tail || _decoder.isOpen() ? decode() : _decoder.available(); }

// Takes all edges, and completes a character that needs no more. Returns how many wait. (The next call takes the edges
// that come meanwhile.)
int SBusPin::decode() {
  if (isOpen == this) {
    const uint8_t head = sbusPinHead;
    if (head != _tail) {
      uint8_t tail = firstBefore(head);
      do {
        tail = _decoder.take<FastEdges>(const_cast<const uint8_t *>(sbusPinEdges), tail, head);
      } while (tail != head);
      setTail(head);
    }
    if (_decoder.isOpen()) {
      const uint8_t state = SREG;
      cli();
      const uint16_t now = TCNT1, last = sbusPinLast;
      const bool isRound = (TIFR1 & _BV(TOV1)) != 0 && now >= last;  // the timer has gone round
      const bool isNew = sbusPinHead != head || (TIFR1 & _BV(ICF1)) != 0;
      SREG = state;
      if (!isNew) {
        _decoder.idle(isRound ? UINT16_MAX : static_cast<uint16_t>(now - last));
      }
    }
  }
  return _decoder.available();
}

int SBusPin::peek() { return available() != 0 && _decoder.isReady() ? _decoder.peek() : -1; }

int SBusPin::read() { return _decoder.isReady() ? _decoder.read() : readLate(); }

// Reads if no character waits yet, or some were lost.
int SBusPin::readLate() { return available() != 0 ? _decoder.read() : -1; }

void sbus::closePin(Stream &port) {
  if (&port == isOpen) {
    static_cast<SBusPin &>(port).end();
  }
}

#define SBUS_MEMORY(name) _SFR_MEM_ADDR(name)

// Notes the edge that the capture unit has seen. Until the unit waits for the opposite one, 28 cycles after this
// begins, it sees none: an edge comes after 160 cycles at the earliest, and the core's other interrupts take some 100.
// A compiler's interrupt switches after 43 cycles, and loses 4 % of the frames.
//
// The comparator has an edge detector of its own, whose flag stands for the edge that the unit does not wait for. So
// the flag stands here only if edges were missed, or if the line has changed back before the unit was switched: a
// spike, if that took less than 4 us in all.
ISR(TIMER1_CAPT_vect, ISR_NAKED) {
  asm volatile(
      "push r24\n"
      "in r24, %[sreg]\n"
      "push r24\n"
      "push r30\n"
      "push r31\n"
      "lds r30, %[tccr]\n"
      "ldi r31, %[ices]\n"
      "eor r30, r31\n"
      "lds r24, %[icr]\n"   // which keeps the high byte for later, too
      "sts %[tccr], r30\n"  // from now on the unit waits for the other edge,
      "in r30, %[acsr]\n"
      "sbrc r30, %[aci]\n"
      "rjmp 5f\n"
      "ldi r31, %[turn]\n"
      "eor r30, r31\n"
      "out %[acsr], r30\n"  // and the flag for the one that has just come
      "lds r31, %[icr]+1\n"
      "lds r30, %[last]\n"
      "sts %[last], r24\n"
      "sub r24, r30\n"
      "lds r30, %[last]+1\n"
      "sts %[last]+1, r31\n"
      "sbc r31, r30\n"
      "sbic %[tifr], %[tov]\n"
      "rjmp 7f\n"
      "1: tst r31\n"
      "brne 6f\n"
      "2: lds r30, %[head]\n"
      "ldi r31, 0\n"
      "subi r30, lo8(-(%[edges]))\n"
      "sbci r31, hi8(-(%[edges]))\n"
      "st Z, r24\n"
      "subi r30, lo8(%[edges]-1)\n"
      "sts %[head], r30\n"
      "3: pop r31\n"
      "pop r30\n"
      "pop r24\n"
      "out %[sreg], r24\n"
      "pop r24\n"
      "reti\n"
      // 128 us or more after the edge before; or earlier, as another library has set the timer back.
      "6: brcc 61f\n"
      "rjmp 54f\n"
      "61: ldi r24, %[longfall]\n"
      "lds r30, %[tccr]\n"
      "sbrc r30, %[ices1]\n"
      "ldi r24, %[longrise]\n"
      "rjmp 2b\n"
      // The timer has gone round: before this edge, after it, or once more than the times tell.
      "7: brcs 71f\n"
      "push r25\n"
      "lds r25, %[tcnt]\n"
      "lds r30, %[last]\n"
      "cp r25, r30\n"
      "lds r25, %[tcnt]+1\n"
      "lds r30, %[last]+1\n"
      "cpc r25, r30\n"
      "pop r25\n"
      "brlo 72f\n"
      "ldi r31, 1\n"
      "71: ldi r30, %[tovf]\n"
      "out %[tifr], r30\n"
      "72: clc\n"
      "rjmp 1b\n"
      // The flag stands: awaits the next change of the level that the line has now.
      "5: push r25\n"
      "push r26\n"
      "lds r25, %[icr]+1\n"
      "in r30, %[acsr]\n"
      "lds r31, %[tccr]\n"
      "bst r31, %[ices1]\n"
      "ori r31, %[ices]\n"
      "ldi r26, %[fall]\n"
      "sbrs r30, %[aco]\n"
      "rjmp 51f\n"
      "cbr r31, %[ices]\n"
      "ldi r26, %[rise]\n"
      "51: sts %[tccr], r31\n"
      "out %[acsr], r26\n"
      "bld r26, 7\n"  // bit 7 of r26 and bit 6 of r31: the edge that the unit was switched to before, and now
      "lsl r31\n"
      "eor r26, r31\n"
      "bst r26, 7\n"  // T: the line has changed back
      "lds r30, %[tcnt]\n"
      "lds r31, %[tcnt]+1\n"
      "sub r30, r24\n"
      "sbc r31, r25\n"
      "tst r31\n"
      "brne 52f\n"
      "cpi r30, %[shortest]\n"
      "brsh 52f\n"
      "brtc 52f\n"
      "ldi r26, %[icf]\n"
      "out %[tifr], r26\n"
      "pop r26\n"
      "pop r25\n"
      "rjmp 3b\n"
      "52: ldi r30, %[flags]\n"
      "out %[tifr], r30\n"
      "sts %[last], r24\n"
      "sts %[last]+1, r25\n"
      "pop r26\n"
      "pop r25\n"
      "54: ldi r24, %[missed]\n"
      "rjmp 2b\n" ::[sreg] "I"(_SFR_IO_ADDR(SREG)),
      [icr] "n"(SBUS_MEMORY(ICR1L)), [tccr] "n"(SBUS_MEMORY(TCCR1B)), [tcnt] "n"(SBUS_MEMORY(TCNT1L)),
      [acsr] "I"(_SFR_IO_ADDR(ACSR)), [tifr] "I"(_SFR_IO_ADDR(TIFR1)), [ices] "M"(_BV(ICES1)), [ices1] "I"(ICES1),
      [aci] "I"(ACI), [aco] "I"(ACO), [turn] "M"(_BV(ACI) | _BV(ACIS0)), [fall] "M"(Comparator),
      [rise] "M"(Comparator | _BV(ACIS0)), [tov] "I"(TOV1), [tovf] "M"(_BV(TOV1)), [icf] "M"(_BV(ICF1)),
      [flags] "M"(_BV(ICF1) | _BV(TOV1)), [shortest] "M"(sbus::EdgeDecoder::ApartMin), [missed] "M"(sbus::edge::Missed),
      [longfall] "M"(sbus::edge::LongFall), [longrise] "M"(sbus::edge::LongRise), [last] "i"(&sbusPinLast),
      [head] "i"(&sbusPinHead), [edges] "i"(sbusPinEdges));
}

#endif

// The condition at which the picture stops: "ch5 > 1500 us and not failsafe".

import { Flag, Kind, LinkState, type Stretch } from './line';

// What a condition is about: a stretch of the line, or the silence after it.
export type Moment = Pick<Stretch, 'kind' | 'flags' | 'state' | 'isTelemetry' | 'channels'>;

type Sign = '<' | '<=' | '=' | '!=' | '>=' | '>';
export type Condition =
  | { is: 'compare'; channel: number; sign: Sign; value: number; scaled?: Uint8Array } // scaled: 1 for each raw value that fulfils it
  | { is: 'flag'; flag: Flag }
  | { is: 'rejected' }
  | { is: 'state'; state: LinkState; equal: boolean }
  | { is: 'not'; of: Condition }
  | { is: 'and' | 'or'; of: Condition[] };

export interface Scaling {
  microseconds(channel: number, raw: number): number;
  percent(channel: number, raw: number): number;
}

// What is wrong with a condition, and where.
export class ConditionError extends Error {
  constructor(
    text: string,
    readonly at: number, // the first character, from 0 on
    readonly length: number,
  ) {
    super(`Character ${at + 1}: ${text}.`);
  }
}

const rawCount = 2048;
const mostChannels = 32;
const states: Record<string, LinkState> = { ok: LinkState.Ok, lossy: LinkState.Lossy, failsafe: LinkState.Failsafe, stale: LinkState.Stale };
const signs: readonly string[] = ['<', '<=', '=', '!=', '>=', '>'];
const words = /\s*(?:([<>!=]=|[<>=()%]|[a-zµ]+\d*|[-+]?\d+(?:\.\d+)?)|(\S))/gi;

interface Word {
  text: string;
  at: number;
}

// Returns the condition in a text. Throws a ConditionError.
export function parse(text: string, scaling: Scaling): Condition {
  const parser = new Parser(text, scaling);
  const condition = parser.any();
  parser.end();
  return condition;
}

class Parser {
  private readonly words: Word[] = [];
  private next = 0;

  constructor(
    private readonly text: string,
    private readonly scaling: Scaling,
  ) {
    for (const { 0: all, 1: known, 2: other, index } of text.matchAll(words)) {
      const word = { text: (known ?? other).toLowerCase().replace('==', '='), at: index + all.length - all.trimStart().length };
      this.words.push(word);
      if (other !== undefined) {
        this.fail(`"${other}" is not understood`, word);
      }
    }
  }

  any(): Condition {
    return this.list('or', () => this.list('and', () => this.one()));
  }

  end(): void {
    if (this.word) {
      this.fail(`"and", "or" or the end is expected, not "${this.word.text}"`);
    }
  }

  private list(is: 'and' | 'or', part: () => Condition): Condition {
    const of = [part()];
    while (this.takes(is)) {
      of.push(part());
    }
    return of.length === 1 ? of[0] : { is, of };
  }

  private one(): Condition {
    if (this.takes('not')) {
      return { is: 'not', of: this.one() };
    }
    if (this.takes('(')) {
      const inner = this.any();
      if (!this.takes(')')) {
        this.fail('")" is expected');
      }
      return inner;
    }
    if (this.takes('failsafe') || this.takes('lostframe')) {
      return { is: 'flag', flag: this.words[this.next - 1].text === 'failsafe' ? Flag.Failsafe : Flag.LostFrame };
    }
    if (this.takes('rejected')) {
      return { is: 'rejected' };
    }
    if (this.takes('state')) {
      return this.state();
    }
    const number = /^ch(\d+)$/.exec(this.word?.text ?? '')?.[1];
    if (number === undefined) {
      this.fail('a channel such as ch5, or failsafe, lostframe, rejected or state is expected');
    }
    return this.compare(Number(number) - 1);
  }

  private state(): Condition {
    const sign = this.takes('=') ? '=' : this.takes('!=') ? '!=' : this.fail('= or != is expected');
    const state = states[this.word?.text ?? ''] ?? this.fail(`one of ${Object.keys(states).join(', ')} is expected`);
    this.next++;
    return { is: 'state', state, equal: sign === '=' };
  }

  private compare(channel: number): Condition {
    if (channel < 0 || channel >= mostChannels) {
      this.fail(`there is no such channel: ch1 to ch${mostChannels} are expected`);
    }
    this.next++;
    const sign = this.word?.text as Sign;
    if (!signs.includes(sign)) {
      this.fail('one of < <= = != >= > is expected');
    }
    this.next++;
    const value = Number(this.word?.text || NaN);
    if (Number.isNaN(value)) {
      this.fail('a number is expected');
    }
    this.next++;
    if (this.takes('us') || this.takes('µs')) {
      return this.scaled(channel, sign, value, (raw) => this.scaling.microseconds(channel, raw));
    }
    if (this.takes('%') || this.takes('percent')) {
      return this.scaled(channel, sign, value, (raw) => this.scaling.percent(channel, raw));
    }
    this.takes('raw');
    return { is: 'compare', channel, sign, value };
  }

  private scaled(channel: number, sign: Sign, value: number, scale: (raw: number) => number): Condition {
    return { is: 'compare', channel, sign, value, scaled: Uint8Array.from({ length: rawCount }, (_, raw) => Number(compares(scale(raw), sign, value))) };
  }

  private get word(): Word | undefined {
    return this.words[this.next];
  }

  private takes(text: string): boolean {
    const is = this.word?.text === text;
    this.next += Number(is);
    return is;
  }

  private fail(text: string, word = this.word): never {
    throw new ConditionError(text, word?.at ?? this.text.trimEnd().length, word?.text.length ?? 0);
  }
}

// Returns true if the condition has a part that `is` accepts.
export function has(condition: Condition, is: (part: Condition) => boolean): boolean {
  const of = condition.is === 'not' ? [condition.of] : condition.is === 'and' || condition.is === 'or' ? condition.of : [];
  return is(condition) || of.some((part) => has(part, is));
}

function compares(one: number, sign: Sign, other: number): boolean {
  switch (sign) {
    case '<': return one < other;
    case '<=': return one <= other;
    case '=': return one === other;
    case '!=': return one !== other;
    case '>=': return one >= other;
    case '>': return one > other;
  }
}

// Returns the value of a channel; NaN if it does not come. CH17 and CH18 of 16 channels are switches.
function channelOf({ channels, flags, kind }: Moment, channel: number): number {
  const isSwitch = kind !== Kind.Row && channels.length === 16 && (channel === 16 || channel === 17);
  return isSwitch ? (flags >> (channel - 16)) & 1 : (channels[channel] ?? NaN);
}

export function holds(condition: Condition, moment: Moment): boolean {
  switch (condition.is) {
    case 'compare': {
      const value = channelOf(moment, condition.channel);
      return condition.scaled ? condition.scaled[value] === 1 : !Number.isNaN(value) && compares(value, condition.sign, condition.value);
    }
    case 'flag': return (moment.flags & condition.flag) !== 0;
    case 'rejected': return moment.kind === Kind.NoFrame && !moment.isTelemetry;
    case 'state': return (moment.state === condition.state) === condition.equal;
    case 'not': return !holds(condition.of, moment);
    case 'and': return condition.of.every((part) => holds(part, moment));
    case 'or': return condition.of.some((part) => holds(part, moment));
  }
}

// Finds the moments at which a condition becomes true.
export class Trigger {
  private last?: Moment;

  // `was`: whether it was true before the first moment.
  constructor(
    readonly condition: Condition,
    private was = false,
  ) {}

  // Returns true if it is true now, and was not at the moment before.
  take(moment: Moment): boolean {
    const is = holds(this.condition, moment);
    const fires = is && !this.was;
    this.was = is;
    this.last = moment;
    return fires;
  }

  // Takes the state of the link at a moment at which nothing came.
  silent(state: LinkState): boolean {
    return this.last !== undefined && this.last.state !== state && this.take({ ...this.last, state });
  }
}

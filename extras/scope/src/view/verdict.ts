// What is wrong with the line at any time, and what to do: the strip of the verdict. Screen readers hear it when it changes.

import { Finding, Flag, LinkState, type Status } from '../border';
import type { Core } from '../core';
import { clock } from '../clock';
import { Announcer, byId, setAttribute, setText } from '../dom';
import { Fault, faultNames, type Problem } from '../messages';
import type { Stretch } from '../native';
import type { Source } from '../source/Source';

const quietestUs = 50000; // after a frame: bytes that come later belong to no frame
const silenceUs = 1000000; // after the newest byte: the line is silent

type Severity = 'good' | 'note' | 'warning' | 'alarm';

interface Verdict extends Problem {
  severity: Severity;
}

// Findings that are neither well nor an alarm.
const severities: Partial<Record<Finding, Severity>> = {
  [Finding.Channels24]: 'note',
  [Finding.PolledTooSeldom]: 'warning',
  [Finding.InterruptsOff]: 'warning',
  [Finding.UnusedFlags]: 'warning',
  [Finding.Noise]: 'warning',
  [Finding.LostInTurn]: 'warning',
  [Finding.Lossy]: 'warning',
  [Finding.LongPeriod]: 'warning',
};

// Of a place with a fault, and of a receiver that does not exist, it never says that all is well.
export function verdictOf(core: Core, source: Source, status: Status, newest?: Stretch): Verdict {
  const line = ofLine(core, source, status, newest);
  const { found } = source;
  if (source.isSimulated && line.severity === 'good') {
    return { text: 'Simulation.', remedy: 'Connect yours with Adapter…, or drop a file.', severity: 'note' };
  }
  return found && line.severity === 'good'
    ? { text: `A fault here: ${faultNames[found.fault]}.`, remedy: `The line around it: ${line.text}`, severity: found.fault === Fault.Late ? 'note' : 'warning' }
    : line;
}

function ofLine(core: Core, source: Source, status: Status, newest?: Stretch): Verdict {
  const { picture: { live }, failure, file } = source.line;
  const problem = failure ?? live?.problem;
  if (problem) {
    return { ...problem, severity: 'alarm' };
  }
  if (file.damage?.length) {
    return { text: file.damage[0], remedy: file.damage[1], severity: 'alarm' };
  }
  if (status.rows > 0 || (status.otherLines > 0 && status.frames === 0)) {
    return ofBoard(status, of(core, Finding.Failsafe));
  }
  if (source.isBoard && status.state === LinkState.NeverSeen) {
    return 4 * status.garbled <= status.characters ? awaited : noText;
  }
  switch (status.state) {
    case LinkState.Failsafe:
      return of(core, (newest?.flags ?? 0) & Flag.ByLosses ? Finding.NoRadio : Finding.Failsafe);
    case LinkState.Stale:
      if (status.finding === Finding.LongPeriod && status.quietUs < silenceUs) {
        return ofFrames(core, status.finding, false, status); // stale between two frames
      }
      return status.ageUs - status.quietUs > quietestUs && status.quietUs < silenceUs
        ? of(core, Finding.NoFrames)
        : { ...of(core, Finding.NoSignal), text: 'Signal lost: frames came before, but no bytes come now.' };
    case LinkState.NeverSeen: {
      const finding = live ? live.round : findingOf(source, status);
      if (!live && status.characters === 0) {
        return { text: 'Nothing has come yet.', remedy: 'The line was silent up to here.', severity: 'note' };
      }
      return finding === undefined
        ? { text: 'Listening.', remedy: 'Waiting for the first frame.', severity: 'note' }
        : of(core, finding);
    }
    default:
      return ofFrames(core, findingOf(source, status), status.state === LinkState.Lossy, status);
  }
}

// Returns the finding of the line's last whole second; if its time stands still before that is over, of all that has come.
function findingOf(source: Source, status: Status): Finding | undefined {
  return status.finding >= 0 ? status.finding : source.stands && status.characters > 0 ? status.findingSoFar : undefined;
}

// Frames come: a finding about older ones must not contradict the newest.
function ofFrames(core: Core, finding: Finding | undefined, lossy: boolean, { gapMeanUs, hadFrames }: Status): Verdict {
  const isOld = finding === undefined || finding === Finding.Failsafe || finding <= Finding.NoFrames;
  if (lossy && (isOld || core.isWell(finding))) {
    return of(core, Finding.Lossy);
  }
  if (finding === Finding.Failsafe || (isOld && hadFrames)) {
    const before = finding === Finding.Failsafe ? 'the receiver was in failsafe' : finding === Finding.NoSignal ? 'the line was silent' : 'few frames came, or none';
    return { text: 'Frames come again.', remedy: `A moment ago ${before}.`, severity: 'warning' };
  }
  if (isOld) {
    return { text: 'Receiving frames.', remedy: 'The verdict needs one second.', severity: 'note' };
  }
  if (finding === Finding.LongPeriod) {
    const found = of(core, finding);
    return { ...found, remedy: `${found.remedy} A frame comes every ${Math.round(gapMeanUs / 1000)} ms.` };
  }
  return of(core, finding === Finding.NoRadio && !lossy ? Finding.Lossy : finding);
}

function of(core: Core, finding: Finding): Verdict {
  return {
    text: core.findingText(finding),
    remedy: core.findingRemedy(finding),
    severity: core.isWell(finding) ? 'good' : (severities[finding] ?? 'alarm'),
  };
}

const awaited: Verdict = {
  text: 'Waiting for rows.',
  remedy: 'A board may restart when its port opens, and a slow sketch takes a while.',
  severity: 'note',
};

const noText: Verdict = {
  text: 'Bytes come, but no rows.',
  remedy: 'Choose the baud rate that the sketch passes to Serial.begin().',
  severity: 'warning',
};

function ofBoard(status: Status, failsafe: Verdict): Verdict {
  if (status.rows === 0) {
    return {
      text: 'Text comes, but no rows of numbers.',
      remedy: 'Upload a sketch that prints 2 to 32 numbers per line, separated by commas, semicolons, tabs or blanks: DecodeSBus, AllChannels or Channels24.',
      severity: 'warning',
    };
  }
  if (status.state === LinkState.Stale) {
    return {
      text: 'No rows: the board prints nothing.',
      remedy: 'Its sketch prints only while frames come: check the wire to the receiver, or upload Diagnose.',
      severity: 'alarm',
    };
  }
  return status.state === LinkState.Failsafe
    ? failsafe
    : { text: 'Receiving rows from a board.', remedy: 'Its sketch decodes the line.', severity: 'good' };
}

const severitiesOfFlight: Severity[] = ['good', 'warning', 'alarm']; // line::FlightVerdict::Severity

// Of a whole recording, once it is decoded: its flight's, or without frames its faults. Undefined before that, and of any other line.
function ofWhole({ flight, faults: map }: Source['line']): Pick<Verdict, 'text' | 'severity'> | undefined {
  if (flight) {
    return { text: flight.text, severity: severitiesOfFlight[flight.severity] };
  }
  const counted = map?.counts.flatMap((count, fault) => (count > 0 ? `${faultNames[fault]} ${count} ${count === 1 ? 'time' : 'times'}` : [])).join(', ');
  return map?.isComplete ? { text: counted ? `${counted[0].toUpperCase()}${counted.slice(1)}.` : 'No faults.', severity: counted ? 'alarm' : 'note' } : undefined;
}

// The verdict has two halves in a recording: of all of it, and of the place where it stands.
export class VerdictView {
  private readonly strip = byId('verdict');
  private readonly text = byId('verdict-text');
  private readonly remedy = byId('verdict-remedy');
  private readonly note = byId('verdict-note');
  private readonly announcer = new Announcer(byId('announcement'));

  draw(verdict: Verdict, { line }: Source, recordedUs?: number): void {
    const whole = ofWhole(line);
    byId('whole').hidden = !whole;
    setAttribute(byId('whole'), 'data-severity', whole?.severity ?? 'note');
    setText(byId('whole-text'), whole?.text ?? '');
    setText(byId('here'), recordedUs === undefined ? '' : `Here (${clock(recordedUs, 1)}): `);
    const note = line.picture.live?.note ?? '';
    setAttribute(this.strip, 'data-severity', verdict.severity);
    setText(this.text, verdict.text);
    setText(this.remedy, verdict.remedy);
    this.note.hidden = note === '';
    setText(this.note, note);
    this.announcer.say(`${verdict.text} ${verdict.remedy}`);
  }
}

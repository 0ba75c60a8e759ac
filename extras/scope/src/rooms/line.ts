// What is shown of any line: its verdict, its values, its bytes, its curves.

import { Kind, LinkState } from '../border';
import type { Core } from '../core';
import { byId } from '../dom';
import { History, isSample } from '../history';
import type { Stretch } from '../native';
import { Sensors } from '../sensors';
import type { Choice } from '../source/choice';
import { RecordingSource } from '../source/recording';
import type { Sink } from '../source/remote';
import type { Source } from '../source/Source';
import { Units } from '../unit';
import { Bars } from '../view/bars';
import { CalibrationView } from '../view/calibration';
import { CountersView } from '../view/counters';
import { Curves } from '../view/curves';
import { FramesView } from '../view/frames';
import { LinkView } from '../view/link';
import { LossesView } from '../view/losses';
import { Names } from '../view/names';
import { SticksView } from '../view/sticks';
import { TelemetryView } from '../view/telemetry';
import { TriggerView } from '../view/trigger';
import { VerdictView, verdictOf } from '../view/verdict';
import type { Room, Shown } from './Room';

export type LineRoom = ReturnType<typeof lineRoom>;

const isTrusted = ({ status: { state } }: Shown): boolean => state === LinkState.Ok || state === LinkState.Lossy;

export function lineRoom(core: Core, choice: Choice<Source>) {
  let newest: Stretch | undefined; // frame or row
  const playing = (): RecordingSource | undefined => (choice.current instanceof RecordingSource ? choice.current : undefined);
  const history = new History();
  const channels = new Set([0, 1, 2, 3]); // that have a curve
  const units = new Units(byId<HTMLSelectElement>('unit'));
  const sensors = new Sensors(core.sensors);
  const names = new Names();
  const curves = new Curves(history, channels, names, sensors, (us) => playing()?.visit(us));
  const frames = new FramesView(core);
  const trigger = new TriggerView(core, curves, frames, () => newest);
  const telemetry = new TelemetryView(sensors, sense);
  const verdict = new VerdictView();
  const link = new LinkView();
  const bars = new Bars(core, channels, names, () => choice.current?.line);
  const sticks = new SticksView(core);
  const calibration = new CalibrationView(core);
  const counters = new CountersView();
  const losses = new LossesView(history);
  byId('reset-marks').addEventListener('click', () => choice.current?.line.ask({ kind: 'resetMarks' }));

  const views: Room['views'] = {
    'The view of the verdict': ({ source, status }) => {
      const found = verdictOf(core, source, status, newest);
      const { flight, file } = source.line;
      verdict.draw(found, source, playing()?.positionUs);
      link.draw(status, newest, found.severity === 'warning' || found.severity === 'alarm', flight?.frames, file.hasTimes);
    },
    'The view of the channels': (shown) => bars.draw(newest, shown.unit, isTrusted(shown)),
    'The calibration': () => calibration.draw(newest),
    'The view of the sticks': (shown) => sticks.draw(newest, shown.unit, isTrusted(shown)),
    'The view of the counters': ({ source }) => counters.draw(source.line.picture),
    'The view of the telemetry': ({ source }) => telemetry.draw(source.line.picture.telemetry),
    'The view of the curves': ({ source, nowUs, status, unit }) => curves.draw(nowUs, newest, unit, status.gapMeanUs, source.line.envelope),
    'The trigger': ({ nowUs }) => trigger.draw(nowUs),
    'The view of the losses': ({ nowUs }) => losses.draw(nowUs, newest?.kind === Kind.Row ? 'rows' : 'frames'),
    'The view of the bytes': () => frames.draw(),
  };

  const sink: Sink = {
    take: (stretch) => {
      core.feedCalibrator(stretch);
      trigger.take(stretch);
      if (stretch.kind !== Kind.Silence) {
        add(stretch);
      }
      if (isSample(stretch)) {
        history.add(stretch);
      }
    },
    jump: (recalled) => {
      trigger.jump();
      forget();
      recalled.forEach(add);
    },
    precede: (samples) => history.precede(samples),
  };

  // Adds bytes of S.Bus: a board that prints numbers has none.
  function add(stretch: Stretch): void {
    if (stretch.kind !== Kind.Row && newest?.kind !== Kind.Row) {
      frames.add(stretch);
    } else if (newest?.kind !== Kind.Row) {
      frames.clear();
    }
    if (stretch.kind !== Kind.NoFrame) {
      newest = stretch;
    }
  }

  // Reads the line's telemetry by the sensors that are chosen; a recording from its beginning on.
  function sense(): void {
    const recording = playing();
    recording?.line.leaving();
    choice.current?.line.ask({ kind: 'sensors', sensors: sensors.bytes });
    recording?.seek(recording.positionUs);
  }

  function forget(): void {
    history.clear();
    frames.clear();
    newest = undefined;
    units.forget();
  }

  return {
    history,
    curves,
    views,
    get newest() {
      return newest;
    },
    leave: forget,
    enter(source: Source): void {
      curves.enter(source.line.file.lengthUs);
      trigger.enter(source);
      telemetry.enter();
      if (sensors.any) {
        sense();
      }
    },
    repaint: () => curves.repaint(),
    // Takes all that has come. Returns what to show.
    show(source: Source): Shown {
      const nowUs = source.nowUs();
      source.line.advance(sink);
      const unit = units.of(newest, source.line.envelope);
      byId('rows').hidden = newest?.kind !== Kind.Row;
      byId('scaling').hidden = !unit.raw;
      return { source, nowUs, status: source.line.picture.status, newest, unit };
    },
  };
}

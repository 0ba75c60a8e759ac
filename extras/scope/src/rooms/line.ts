// What comes of any line: its curves, its bytes, and the trigger that stops both.

import { Kind } from '../border';
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
import { Curves } from '../view/curves';
import { FramesView } from '../view/frames';
import { Names } from '../view/names';
import { TriggerView } from '../view/trigger';
import type { Room, Shown } from './Room';

export type LineRoom = ReturnType<typeof lineRoom>;

export function lineRoom(core: Core, choice: Choice<Source>) {
  let newest: Stretch | undefined; // frame or row
  const history = new History();
  const channels = new Set([0, 1, 2, 3]); // that have a curve
  const units = new Units(byId<HTMLSelectElement>('unit'));
  const sensors = new Sensors(core.sensors);
  const names = new Names();
  const curves = new Curves(history, channels, names, sensors, (us) => choice.current instanceof RecordingSource && choice.current.visit(us));
  const frames = new FramesView(core);
  const trigger = new TriggerView(core, curves, frames, () => newest);

  const views: Room['views'] = {
    'The view of the curves': ({ source, nowUs, status, unit }) => curves.draw(nowUs, newest, unit, status.gapMeanUs, source.line.envelope),
    'The trigger': ({ nowUs }) => trigger.draw(nowUs),
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

  function forget(): void {
    history.clear();
    frames.clear();
    newest = undefined;
    units.forget();
  }

  return {
    history,
    channels,
    names,
    sensors,
    curves,
    views,
    get newest() {
      return newest;
    },
    leave: forget,
    enter(source: Source): void {
      curves.enter(source.line.file.lengthUs);
      trigger.enter(source);
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

// What is found of the line: its verdict, the link, and what was counted and lost.

import { Kind } from '../border';
import type { Core } from '../core';
import { byId } from '../dom';
import type { Choice } from '../source/choice';
import { RecordingSource } from '../source/recording';
import type { Source } from '../source/Source';
import { CountersView } from '../view/counters';
import { LinkView } from '../view/link';
import { LossesView } from '../view/losses';
import { VerdictView, verdictOf } from '../view/verdict';
import type { LineRoom } from './line';
import type { Room } from './Room';

export function verdictRoom(core: Core, choice: Choice<Source>, { history }: LineRoom): Room {
  const verdict = new VerdictView();
  const link = new LinkView();
  const counters = new CountersView();
  const losses = new LossesView(history);
  byId('reset-marks').addEventListener('click', () => choice.current?.line.ask({ kind: 'resetMarks' }));
  return {
    views: {
      'The view of the verdict': ({ source, status, newest }) => {
        const found = verdictOf(core, source, status, newest);
        const { flight, file } = source.line;
        verdict.draw(found, source, source instanceof RecordingSource ? source.positionUs : undefined);
        link.draw(status, newest, found.severity === 'warning' || found.severity === 'alarm', flight?.frames, file.hasTimes);
      },
      'The view of the counters': ({ source }) => counters.draw(source.line.picture),
      'The view of the losses': ({ nowUs, newest }) => losses.draw(nowUs, newest?.kind === Kind.Row ? 'rows' : 'frames'),
    },
  };
}

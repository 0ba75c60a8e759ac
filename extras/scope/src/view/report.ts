// A whole recording at a glance: its verdict, its figures, its worst seconds and its longest faults, each of which can be visited.

import { FlightKind } from '../border';
import { clock } from '../clock';
import { byId, make, setText } from '../dom';
import { Fault, faultNames, type Flight, type FlightPart } from '../messages';
import type { RecordingSource } from '../source/recording';

const kinds = [FlightKind.Failsafe, FlightKind.NoPulses, FlightKind.NoFrames, FlightKind.LostFrame, FlightKind.Jump, FlightKind.Late];
const nameOf = (kind: FlightKind): string => kind === FlightKind.Jump ? 'jumps' : faultNames[Fault[FlightKind[kind] as keyof typeof Fault]];
const shownUs = 2000; // after a frame it is seen

const seconds = (us: number): string => `${(us / 1e6).toFixed(3)} s`;

export class ReportView {
  private shown?: Flight;
  private source?: RecordingSource;
  private readonly card = byId('report');
  private readonly lists = byId('report-lists');

  // `visit`: goes to a time in the recording, in us.
  constructor(private readonly visit: (us: number) => void) {
    byId('report-open').addEventListener('click', () => void this.open());
  }

  draw(source: RecordingSource | undefined): void {
    this.source = source;
    const flight = source?.line.flight;
    if (flight !== this.shown) {
      this.shown = flight;
      this.card.hidden = !flight;
      if (flight) {
        this.show(flight);
      }
    }
  }

  private show(flight: Flight): void {
    const { hasTimes } = (this.source as RecordingSource).line.file;
    const [length, rate, missing] = hasTimes
      ? [`${seconds(flight.toUs - flight.fromUs)} long: `, `, ${flight.framesPerSecond.toFixed(1)} a second`, `, ${flight.missing} missing`]
      : ['Times are not known: ', '', ''];
    setText(
      byId('report-facts'),
      `${length}${flight.frames} frames${rate}; ${flight.lostFrames} with the lost-frame flag${missing}, ${flight.failsafeFrames} in failsafe; ` +
        `${flight.discardedBytes} discarded bytes, ${flight.characterErrors} character errors.`,
    );
    byId('report-open').hidden = this.lists.hidden = !hasTimes;
    const { worst, spans } = flight;
    const other = [FlightKind.Failsafe, FlightKind.NoPulses, FlightKind.NoFrames].some((kind) => spans[kind].count > 0) ? 'other ' : '';
    this.lists.replaceChildren(
      listOf(worst.length > 0 ? `The worst ${other}seconds` : `No ${other}second has a lost frame`, worst.map((part) => [part[0], part[1], textOf(part)]), this.visit),
      ...kinds.filter((kind) => spans[kind].count > 0).map((kind) => {
        const { count, us, longest } = spans[kind];
        const more = count > longest.length ? `; the ${longest.length} longest` : '';
        return listOf(
          `${nameOf(kind).replace(/^./, (first) => first.toUpperCase())}: ${count} ${count === 1 ? 'time' : 'times'}, ${seconds(us)} in all${more}`,
          longest.map(([fromUs, toUs, channels]) => [fromUs, fromUs + shownUs, channels || seconds(toUs - fromUs)]),
          this.visit,
        );
      }),
    );
  }

  // Opens the report in a tab of its own, to look at, to print or to save.
  private async open(): Promise<void> {
    const html = await this.source?.line.report();
    if (html) {
      const url = URL.createObjectURL(new Blob([html], { type: 'text/html' }));
      window.open(url, '_blank');
      setTimeout(() => URL.revokeObjectURL(url), 60000);
    }
  }
}

// Each row: the time that is shown, the time that is visited, in us, and a text. `visit`: goes there.
function listOf(title: string, rows: [number, number, string][], visit: (us: number) => void): HTMLElement {
  const items = rows.map(([fromUs, toUs, text]) => {
    const button = make('button', {}, clock(fromUs));
    button.addEventListener('click', () => visit(toUs));
    return make('li', {}, button, make('span', {}, text));
  });
  return make('section', {}, make('h3', {}, title), make('ol', {}, ...items));
}

function textOf([, , lost, kind]: FlightPart): string {
  const what = kind === FlightKind.LostFrame ? '' : `, ${nameOf(kind)}`;
  return `${(100 * lost).toFixed(1)} % lost${what}`;
}

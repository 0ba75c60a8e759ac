// Ties a source to the views: takes what comes from it, and draws that sixty times a second.

import { setZero } from './clock';
import { Bookmarks } from './bookmarks';
import { Channels } from './channels';
import type { Core } from './core';
import { Doctor } from './doctor';
import { byId, setText } from './dom';
import { History, isSample } from './history';
import { Kind, LinkState, type Sink, type Stretch } from './line';
import type { Problem, Samples, State } from './messages';
import { Recorder } from './recorder';
import { Choice } from './source/choice';
import { RecordingSource } from './source/recording';
import type { Second } from './source/second';
import type { Source } from './source/Source';
import { Sensors } from './sensors';
import { Units } from './unit';
import { Bars } from './view/bars';
import { BookmarksView } from './view/bookmarks';
import { CountersView } from './view/counters';
import { Curves } from './view/curves';
import { FramesView } from './view/frames';
import { LinkView } from './view/link';
import { NamesView } from './view/names';
import { Room } from './view/room';
import { SecondView } from './view/second';
import { StatisticsView } from './view/statistics';
import { SticksView } from './view/sticks';
import { TelemetryView } from './view/telemetry';
import { Timeline } from './view/timeline';
import { TriggerView } from './view/trigger';
import { VerdictView } from './view/verdict';
import { WireView } from './view/wire';

const pollAfter = 1000; // stretches

// Follows the title: what the source is doing.
const asides: Record<State, string> = {
  closed: '',
  choosing: ' (until the next one is ready)',
  opening: ' (opening)',
  open: '',
  reopening: ' (opening again)',
  failed: ' (not open)',
};

export class Scope implements Sink {
  readonly history = new History();
  readonly recorder = new Recorder();
  readonly curves: Curves;
  readonly choice = new Choice<Source>(() => this.leave(), (source) => this.enter(source), () => this.mayLeave());
  newest?: Stretch; // frame or row
  reading = ''; // the file that is being read, and how much of it

  private readonly units = new Units(byId<HTMLSelectElement>('unit'));
  private taken = 0;
  private readonly broken = new Set<string>(); // views
  private doctor?: Doctor;
  private readonly channels = new Channels();
  private readonly names = new NamesView(this.channels);
  private readonly bars: Bars;
  private readonly sticks: SticksView;
  private readonly link = new LinkView(byId('link'));
  private readonly verdict = new VerdictView();
  private readonly counters = new CountersView(byId('counters'));
  private readonly sensors: Sensors;
  private readonly telemetry: TelemetryView;
  private readonly statistics = new StatisticsView(this.history);
  private readonly frames: FramesView;
  private readonly bookmarks = new Bookmarks();
  private readonly bookmarksView: BookmarksView;
  private readonly secondView = new SecondView((us) => this.visit(us), () => this.endComparison());
  private second?: Second; // a line beside the one that is shown
  private asking?: AbortController;
  private readonly timeline: Timeline;
  private readonly trigger: TriggerView;
  private readonly room = new Room();
  private readonly wire = new WireView();

  // `failed`: called once for each view that throws.
  constructor(
    private readonly core: Core,
    private readonly failed: (view: string, error: Error) => void,
    problem: (problem: Problem) => void,
  ) {
    this.sensors = new Sensors(core.sensors);
    this.telemetry = new TelemetryView(this.sensors, () => this.sense());
    this.bars = new Bars(byId('bars'), core, this.channels, () => this.choice.current?.line);
    this.sticks = new SticksView(byId('sticks'), core);
    this.frames = new FramesView(core, byId('bits'), byId('bit-text'), byId('lines'), byId('hold'));
    this.curves = new Curves(byId('plot'), this.history, this.channels, this.sensors, (us) => this.visit(us), {
      pause: byId('pause'),
      window: byId('window'),
      readout: byId('readout'),
      cursors: byId('cursors'),
      table: byId('cursor-values'),
    });
    this.timeline = new Timeline(this.bookmarks, () => this.endRecording());
    this.bookmarksView = new BookmarksView(this.bookmarks, () => this.shownUs, (us) => this.visit(us), problem);
    this.trigger = new TriggerView(core, this.curves, this.frames, () => this.newest, () => this.endRecording());
  }

  // Saves what was recorded.
  endRecording(): void {
    if (this.recorder.on) {
      this.bookmarks.saved(this.choice.current?.line.recordingUs);
    }
    this.recorder.end(this.bookmarks.all, this.choice.current?.line.us ?? 0);
  }

  // Returns how many bookmarks are lost with the line: the recording that runs, if one does, is saved.
  get lostBookmarks(): number {
    return this.bookmarks.lost(this.recorder.on ? this.choice.current?.line.recordingUs : undefined);
  }

  private mayLeave(): boolean {
    const lost = this.lostBookmarks;
    return lost === 0 || confirm(`${lost === 1 ? 'A bookmark is' : `${lost} bookmarks are`} not saved, and will be lost. Go on?`);
  }

  // The time that is shown, in us: a recording's position, or the curves' right edge.
  private get shownUs(): number {
    return this.recording?.positionUs ?? this.curves.shownUs[1];
  }

  private get recording(): RecordingSource | undefined {
    const { current } = this.choice;
    return current instanceof RecordingSource ? current : undefined;
  }

  private visit(us: number): void {
    if (this.recording) {
      this.timeline.visit(us);
    } else {
      this.curves.show(us);
    }
  }

  // Redraws what depends on the theme.
  repaint(): void {
    this.curves.repaint();
    this.wire.repaint();
    this.secondView.repaint();
  }

  private leave(): void {
    this.endRecording();
    this.endComparison();
    this.forget();
    this.curves.forget();
  }

  private enter(source: Source): void {
    setZero(source.line.file.zeroUs ?? 0);
    this.doctor = new Doctor(this.core, source);
    this.trigger.enter(source);
    this.room.enter();
    this.bookmarksView.enter(source);
    this.telemetry.enter();
    if (this.sensors.any) {
      this.sense();
    }
    this.wire.show(this.recording);
    this.timeline.show(this.recording);
  }

  // Reads the line's telemetry by the sensors that are chosen; a recording from its beginning on.
  private sense(): void {
    const { recording } = this;
    if (recording) {
      this.endRecording();
    }
    this.choice.current?.line.ask({ kind: 'sensors', sensors: this.sensors.bytes });
    recording?.seek(recording.positionUs);
  }

  // Compares the line that is shown with a second one. Throws what `read` throws, unless another source was chosen.
  async compare(read: (signal: AbortSignal) => Promise<Second>): Promise<void> {
    this.endComparison();
    const { signal } = (this.asking = new AbortController());
    try {
      this.second = await read(signal);
      this.secondView.show(this.second);
    } catch (error) {
      if (!signal.aborted) {
        throw error;
      }
    }
  }

  // Ends the comparison.
  private endComparison(): void {
    this.asking?.abort();
    this.second?.close();
    this.second = undefined;
    this.secondView.show(undefined);
  }

  // Takes a stretch of the line.
  take(stretch: Stretch): void {
    this.core.feedCalibrator(stretch);
    this.trigger.take(stretch);
    if (stretch.kind === Kind.Silence) {
      return;
    }
    this.show(stretch);
    if (++this.taken % pollAfter === 0) {
      this.recorder.poll(); // a page in the background draws nothing
    }
    if (isSample(stretch)) {
      this.history.add(stretch);
    }
  }

  jump(recalled: readonly Stretch[]): void {
    this.trigger.jump();
    this.forget();
    recalled.forEach((stretch) => this.show(stretch));
  }

  precede(samples: Samples): void {
    this.history.precede(samples);
  }

  // Shows bytes of S.Bus: a board that prints numbers has none.
  private show(stretch: Stretch): void {
    if (stretch.kind !== Kind.Row && this.newest?.kind !== Kind.Row) {
      this.frames.add(stretch);
    } else if (this.newest?.kind !== Kind.Row) {
      this.frames.clear();
    }
    if (stretch.kind !== Kind.NoFrame) {
      this.newest = stretch;
    }
  }

  draw(): void {
    const source = this.choice.current;
    if (!source) {
      return;
    }
    const nowUs = source.nowUs();
    source.line.advance(this);
    this.recorder.poll();
    const status = source.line.status();
    const { newest } = this;
    const unit = this.units.of(newest, source.line.envelope);
    byId('rows').hidden = newest?.kind !== Kind.Row;
    const aside = this.reading || source.progress ? ` (${this.reading || source.progress})` : asides[this.choice.state];
    setText(byId('title'), source.title + (source.device ? `, ${source.device}` : '') + aside);
    const trusted = status.state === LinkState.Ok || status.state === LinkState.Lossy;
    byId('scaling').hidden = !unit.raw;
    this.second?.follow();
    const { live } = source.line;
    this.curves.name(this.bookmarks.all);
    const doctor = this.doctor as Doctor;
    const views: Record<string, () => void> = {
      'The choice of views': () => this.room.draw(source, status, newest),
      'The view of the verdict': () => this.verdict.draw(doctor.verdict(status, newest), live?.note ?? ''),
      'The view of the link': () => this.link.draw(status, newest, source.line.isPreview),
      'The view of the channels': () => this.bars.draw(newest, unit, trusted),
      'The view of the sticks': () => this.sticks.draw(newest, unit, trusted),
      'The view of the names': () => this.names.draw(newest?.channels.length || 16),
      'The view of the counters': () => this.counters.draw(status, live?.events, source.line.isPreview),
      'The view of the telemetry': () => this.telemetry.draw(source.line.telemetry()),
      'The view of the bookmarks': () => this.bookmarksView.draw(),
      'The view of the curves': () => this.curves.draw(nowUs, newest, unit, status.gapMeanUs, source.line.envelope),
      'The comparison': () => this.secondView.draw(this.curves.shownAs),
      'The trigger': () => this.trigger.draw(nowUs),
      'The view of the intervals': () => this.statistics.draw(nowUs, newest?.kind === Kind.Row ? 'rows' : 'frames'),
      'The view of the bytes': () => this.frames.draw(),
      'The view of the wire': () => this.wire.draw(),
      'The time line': () => this.timeline.draw(...this.curves.shownUs),
    };
    Object.entries(views).forEach(([view, draw]) => this.guard(view, draw));
  }

  // A view that throws is not drawn any more; the others are.
  private guard(view: string, draw: () => void): void {
    try {
      if (!this.broken.has(view)) {
        draw();
      }
    } catch (error) {
      this.broken.add(view);
      this.failed(view, error as Error);
    }
  }

  private forget(): void {
    this.history.clear();
    this.frames.clear();
    this.newest = undefined;
    this.units.forget();
  }
}

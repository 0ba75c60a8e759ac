// The page's buttons.

import './style.css';
import { Core } from './core';
import { byId, setText } from './dom';
import type { Problem, Setting } from './messages';
import { Kind } from './line';
import { keepOffline } from './offline';
import { saveCsv, savePicture } from './recorder';
import { Scope } from './scope';
import { pickPort, type PortKind } from './source/pick';
import { PortSource } from './source/port';
import { RecordingSource } from './source/recording';
import { SecondPort, SecondRecording } from './source/second';
import { SimulatedSource } from './source/simulated';
import { keep, recall } from './storage';
import { CalibrationView } from './view/calibration';
import { KnownPorts } from './view/knownPorts';
import { NoticeView } from './view/notice';
import { splitPanes } from './view/panes';
import { ScaleView } from './view/scale';

const stays = 'Save the recording, and reload the page.';
let notice: NoticeView | undefined;

// Shows the page's own failures: a blank page says nothing. The line's verdict is drawn over it: so once the page draws, it is a
// notice that stays.
let said = '';
function fault(error: unknown): void {
  const text = `The page has failed: ${error instanceof Error ? error.message : error}.`;
  if (text !== said) {
    notice?.show({ text, remedy: stays }, true);
  }
  said = text;
  byId('verdict').dataset.severity = 'alarm';
  setText(byId('verdict-text'), text);
  setText(byId('verdict-remedy'), 'Reload it in a browser released this year or last year.');
}
addEventListener('error', (event) => event.error && fault(event.error)); // without an error it is an observer's complaint
addEventListener('unhandledrejection', (event) => fault(event.reason));

const core = await Core.load();
notice = new NoticeView();
const scope = new Scope(core, (view, error) => notice?.show({ text: `${view} has failed: ${error.message}.`, remedy: `Everything else continues. ${stays}` }, true), (problem) => notice?.show(problem));
const known = new KnownPorts(byId('known'), (port, kind) => void open(port, kind));
const select = (id: string): HTMLSelectElement => byId<HTMLSelectElement>(id);

function pressed(source: string): void {
  for (const name of ['simulated', 'adapter', 'board', 'recording']) {
    byId(`source-${name}`).setAttribute('aria-pressed', String(name === source));
  }
  byId('simulation').hidden = source !== 'simulated';
  byId('board').hidden = source !== 'board';
  byId('compare').hidden = source !== 'adapter' && source !== 'recording';
}

let simulated = { receiver: '16', fault: 'none' }; // the choices of the simulation that runs, or ran last

async function simulate(): Promise<void> {
  const receiver = select('receiver').value;
  const fault = select('fault').value;
  const line: Setting = { baud: 100000, inverted: true };
  const port = { baud: fault === 'baud' ? 200000 : 100000, inverted: fault !== 'inversion' };
  const channels = receiver === '24' ? 24 : receiver === '32' ? 32 : 16;
  const noise = { noise: 30, storm: 300 }[fault] ?? 0;
  const isChosen = await scope.choice.change(async (signal) => {
    const make = await SimulatedSource.open(core, { calibration: receiver === 'calibration', channels, noise, line }, port, signal);
    return () => {
      pressed('simulated');
      const source = make();
      source.cutWire(fault === 'silent');
      byId('cut').setAttribute('aria-pressed', String(fault === 'silent'));
      simulated = { receiver, fault };
      return source;
    };
  });
  if (!isChosen) {
    Object.entries(simulated).forEach(([id, value]) => (select(id).value = value));
  }
}

async function connect(kind: PortKind): Promise<void> {
  notice?.hide();
  try {
    const port = await scope.choice.ask(() => pickPort(kind));
    if (port) {
      await open(port, kind);
    }
  } catch (problem) {
    notice?.show(problem as Problem);
  }
}

async function open(port: SerialPort, kind: PortKind): Promise<void> {
  notice?.hide();
  const { current } = scope.choice;
  if (current instanceof PortSource && current.isUnplugged && current.isBoard === (kind === 'board') && current.has(port)) {
    await current.replug(port);
    return;
  }
  const isChosen = await scope.choice.change(async (signal) => {
    const make = await PortSource.open(core, port, kind, Number(select('baud').value), signal);
    return () => {
      pressed(kind);
      return make();
    };
  });
  if (isChosen) {
    known.remember(port, kind);
  }
}

// Asks for a second line: a recording beside a recording, a port beside a port.
async function compare(): Promise<void> {
  const { current } = scope.choice;
  notice?.hide();
  if (!(current instanceof PortSource)) {
    byId('second-file').click();
    return;
  }
  try {
    const port = await pickPort('adapter');
    if (scope.choice.current === current) {
      await scope.compare((signal) => SecondPort.open(core, port, current, signal));
    }
  } catch (problem) {
    notice?.show(problem as Problem);
  }
}

async function compareFile(file: File | undefined): Promise<void> {
  const { current } = scope.choice;
  notice?.hide();
  try {
    if (file && current instanceof RecordingSource) {
      await scope.compare((signal) => SecondRecording.read(core, file, current, signal));
    }
  } catch (error) {
    rejected(error);
  }
}

function rejected(error: unknown): void {
  notice?.show(!(error instanceof Error) ? (error as Problem) : {
    text: `This cannot be played: ${error.message}.`,
    remedy: 'A line of a recording holds a time in microseconds, then bytes in hexadecimal: 120 0F E5 03 ... A capture of the wire is VCD, a session of PulseView (.sr), or CSV of Saleae, PulseView, DSView or an oscilloscope; sbus decode also takes options.',
  });
}

async function play(file: File | undefined, signal?: string, before?: RecordingSource): Promise<void> {
  if (!file) {
    return;
  }
  notice?.hide();
  try {
    await scope.choice.change(async (abort) => {
      const read = (part: number): void => void (scope.reading = `reading ${file.name}: ${Math.floor(100 * part)} %`);
      const make = await RecordingSource.read(core, file, abort, read, signal, before);
      return () => {
        pressed('recording');
        return make();
      };
    });
  } catch (error) {
    rejected(error);
  } finally {
    scope.reading = '';
  }
}

function wire(): void {
  byId('source-simulated').addEventListener('click', simulate);
  byId('source-adapter').addEventListener('click', () => connect('adapter'));
  byId('source-board').addEventListener('click', () => connect('board'));
  byId('source-recording').addEventListener('click', () => byId('file').click());
  byId('compare').addEventListener('click', compare);
  for (const [id, take] of [['file', play], ['second-file', compareFile]] as const) {
    byId<HTMLInputElement>(id).addEventListener('change', (event) => {
      const input = event.target as HTMLInputElement;
      void take(input.files?.[0]);
      input.value = '';
    });
  }
  select('baud').value = [...select('baud').options].find(({ value }) => value === recall('baud'))?.value ?? '115200';
  select('baud').addEventListener('change', () => {
    keep('baud', select('baud').value);
    if (scope.choice.current instanceof PortSource) {
      scope.choice.current.use(Number(select('baud').value));
    }
  });
  select('wire-signal').addEventListener('change', () => {
    const { current } = scope.choice;
    if (current instanceof RecordingSource) {
      void play(current.file, select('wire-signal').value, current);
    }
  });
  select('receiver').addEventListener('change', simulate);
  select('fault').addEventListener('change', simulate);
  byId('cut').addEventListener('click', () => {
    const cut = byId('cut').getAttribute('aria-pressed') !== 'true';
    byId('cut').setAttribute('aria-pressed', String(cut));
    if (scope.choice.current instanceof SimulatedSource) {
      scope.choice.current.cutWire(cut);
    }
  });

  byId('record').addEventListener('click', () => {
    const { current } = scope.choice;
    if (scope.recorder.on) {
      scope.endRecording();
    } else if (current) {
      scope.recorder.begin(current.line, current.title);
    }
  });
  addEventListener('beforeunload', (event) => (scope.recorder.on || scope.lostBookmarks > 0) && event.preventDefault());
  byId('csv').addEventListener('click', () => saveCsv(scope.history, scope.newest?.channels.length ?? 16, scope.newest?.kind === Kind.Row));

  byId('picture').addEventListener('click', () => savePicture(scope.curves.svg(scope.choice.current?.title ?? '')));
  byId('pause').addEventListener('click', () => scope.curves.pause(!scope.curves.paused));
  byId('zoom-in').addEventListener('click', () => scope.curves.zoom(1));
  byId('zoom-out').addEventListener('click', () => scope.curves.zoom(-1));
  byId('reset-marks').addEventListener('click', () => scope.choice.current?.line.resetMarks());
  takeDrops(byId('drop'));
}

// Plays a file that is dropped on the page.
function takeDrops(curtain: HTMLElement): void {
  const hasFile = ({ dataTransfer }: DragEvent): boolean => dataTransfer?.types.includes('Files') ?? false;
  addEventListener('dragover', (event) => {
    if (hasFile(event)) {
      event.preventDefault();
      curtain.hidden = false;
    }
  });
  addEventListener('dragleave', (event) => (curtain.hidden ||= event.relatedTarget === null));
  addEventListener('drop', (event) => {
    curtain.hidden = true;
    const [item] = event.dataTransfer?.items ?? [];
    const [file] = event.dataTransfer?.files ?? [];
    if (file) {
      event.preventDefault();
    }
    if (item?.webkitGetAsEntry?.()?.isDirectory) {
      notice?.show({ text: `${file.name} is a folder.`, remedy: 'Drop a recording or a capture that is in it.' });
    } else {
      void play(file);
    }
  });
}

// Follows the system's dark or light theme until the button is pressed.
function themes(): void {
  const dark = matchMedia('(prefers-color-scheme: dark)');
  byId('theme').addEventListener('click', () => {
    const now = document.documentElement.dataset.theme ?? (dark.matches ? 'dark' : 'light');
    document.documentElement.dataset.theme = now === 'dark' ? 'light' : 'dark';
    scope.repaint();
  });
  for (const query of [dark, matchMedia('(forced-colors: active)')]) {
    query.addEventListener('change', () => scope.repaint());
  }
}

function recordButton(): void {
  byId('record').setAttribute('aria-pressed', String(scope.recorder.on));
  setText(byId('record-text'), scope.recorder.on ? `Save ${Math.ceil(scope.recorder.bytes / 1000)} kB` : 'Record');
}

wire();
themes();
splitPanes();
void keepOffline();
const scale = new ScaleView(core);
const calibration = new CalibrationView(core, () => scale.calibrated());
await simulate();

function picture(): void {
  requestAnimationFrame(picture); // first: a view that throws ends no other picture
  scope.draw();
  const { current } = scope.choice;
  known.draw((port) => current instanceof PortSource && current.has(port));
  calibration.draw();
  recordButton();
}
picture();

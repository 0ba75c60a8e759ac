// The newest values: of channels, as bars, sticks and calibration, and of telemetry.

import { LinkState } from '../border';
import type { Core } from '../core';
import type { Choice } from '../source/choice';
import { RecordingSource } from '../source/recording';
import type { Source } from '../source/Source';
import { Bars } from '../view/bars';
import { CalibrationView } from '../view/calibration';
import { SticksView } from '../view/sticks';
import { TelemetryView } from '../view/telemetry';
import type { LineRoom } from './line';
import type { Room, Shown } from './Room';

const isTrusted = ({ status: { state } }: Shown): boolean => state === LinkState.Ok || state === LinkState.Lossy;

export function channelsRoom(core: Core, choice: Choice<Source>, { channels, names, sensors }: LineRoom): Room {
  const bars = new Bars(core, channels, names, () => choice.current?.line);
  const sticks = new SticksView(core);
  const calibration = new CalibrationView(core);
  const telemetry = new TelemetryView(sensors, sense);

  // Reads the line's telemetry by the sensors that are chosen; a recording from its beginning on.
  function sense(): void {
    const { current } = choice;
    const recording = current instanceof RecordingSource ? current : undefined;
    recording?.line.leaving();
    current?.line.ask({ kind: 'sensors', sensors: sensors.bytes });
    recording?.seek(recording.positionUs);
  }

  return {
    views: {
      'The view of the channels': (shown) => bars.draw(shown.newest, shown.unit, isTrusted(shown)),
      'The calibration': ({ newest }) => calibration.draw(newest),
      'The view of the sticks': (shown) => sticks.draw(shown.newest, shown.unit, isTrusted(shown)),
      'The view of the telemetry': ({ source }) => telemetry.draw(source.line.picture.telemetry),
    },
    enter: () => {
      telemetry.enter();
      if (sensors.any) {
        sense();
      }
    },
  };
}

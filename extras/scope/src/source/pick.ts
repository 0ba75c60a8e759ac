// The browser's dialog, in which the user picks a port.

import type { Problem } from './Source';

export type PortKind = 'adapter' | 'board';

const noWebSerial: Problem = {
  text: 'This browser has no Web Serial.',
  remedy: 'To read a port, open this page in Chrome, Edge or Firefox (from 151 on) on a computer; or let sbus record it, and drop the file here.',
};

// Returns the port that the user picks. Throws a Problem without one.
export async function pickPort(kind: PortKind): Promise<SerialPort> {
  if (!navigator.serial) {
    throw noWebSerial;
  }
  try {
    return await navigator.serial.requestPort();
  } catch (error) {
    throw whyNoPort(error as DOMException, kind);
  }
}

function whyNoPort({ name, message }: DOMException, kind: PortKind): Problem {
  if (name === 'NotFoundError') {
    return { text: 'No port was chosen.', remedy: `Plug the ${kind} in, press the button again, and choose it in the list.` };
  }
  return {
    text: `The browser offers no port: ${message}`,
    remedy: 'Allow this page to use one. If the page was opened from disk and the browser rejects it, make scope serves it.',
  };
}

// The browser's dialog, in which the user picks a port.

import type { Problem } from '../messages';

export type PortKind = 'adapter' | 'board';

const noWebSerial: Problem = {
  text: 'This browser has no Web Serial.',
  remedy: 'To read a port, open this page in Chrome, Edge or Firefox (151 or later) on a computer. Or record the port with sbus, and drop the file here.',
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
    remedy: 'Allow this page to use a port. If the browser refuses because the page was opened from disk, serve it with make scope.',
  };
}

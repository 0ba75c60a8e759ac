// A port's device: the browser's dialog, in which the user picks it, and its name. Web Serial gives only its USB IDs; the names are those of the list of USB IDs (linux-usb.org).

import type { Problem } from '../messages';

const vendors: Record<string, string> = {
  '0403': 'FTDI', '0483': 'STMicroelectronics', '067b': 'Prolific', '10c4': 'Silicon Labs', '16c0': 'Teensy', '1a86': 'WCH', '1b4f': 'SparkFun',
  '2341': 'Arduino', '239a': 'Adafruit', '2a03': 'Arduino', '2e8a': 'Raspberry Pi', '303a': 'Espressif',
};
const products: Record<string, string> = {
  '0403:6001': 'FT232', '0403:6010': 'FT2232', '0403:6014': 'FT232H', '0403:6015': 'FT231X', '067b:2303': 'PL2303', '10c4:ea60': 'CP210x',
  '1a86:7523': 'CH340', '2341:0042': 'Mega 2560', '2341:0043': 'Uno',
};

type Numbers = ReturnType<SerialPort['getInfo']>;

const hex = (number: number): string => number.toString(16).padStart(4, '0');

// Returns 0403:6001, or '' for a port that is no USB device.
export function idsOf({ usbVendorId, usbProductId }: Numbers): string {
  return usbVendorId === undefined || usbProductId === undefined ? '' : `${hex(usbVendorId)}:${hex(usbProductId)}`;
}

// Returns "FTDI FT232 (0403:6001)".
export function deviceName(info: Numbers): string {
  const ids = idsOf(info);
  const names = [vendors[ids.slice(0, 4)], products[ids]].filter(Boolean);
  return ids === '' ? 'serial port' : names.length > 0 ? `${names.join(' ')} (${ids})` : `USB ${ids}`;
}

// Returns true for FTDI: most adapters for S.Bus are theirs, since those can invert.
export function isLikelyAdapter(info: Numbers): boolean {
  return idsOf(info).startsWith('0403');
}

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

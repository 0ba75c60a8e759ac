// Files that are packed: a ZIP's directory, and bytes as they come. PKWARE's APPNOTE.TXT, 4.3.

export interface Entry {
  at: number; // offset of its header
  packed: number; // bytes
  size: number;
  crc: number;
  isPacked: boolean;
}

const end = { signature: 0x06054b50, size: 22, commentMax: 65535 };
const listed = { signature: 0x02014b50, size: 46 };
const header = { signature: 0x04034b50, size: 30 };
const encrypted = 1;
const methods = { stored: 0, deflated: 8 };
const zip64 = 0xffffffff; // the number stands elsewhere: over 4 GB

async function view(file: File, from: number, to: number): Promise<DataView> {
  return new DataView(await file.slice(Math.max(from, 0), to).arrayBuffer());
}

// Returns the entries by their names. Throws an Error that says why there are none.
export async function directory(file: File): Promise<Map<string, Entry>> {
  const tail = await view(file, file.size - end.size - end.commentMax, file.size);
  let at = tail.byteLength - end.size;
  while (at >= 0 && tail.getUint32(at, true) !== end.signature) at--;
  if (at < 0) {
    throw new Error('the ZIP has no directory: is it incomplete?');
  }
  const [size, from] = [tail.getUint32(at + 12, true), tail.getUint32(at + 16, true)];
  const list = await view(file, from, from + size);
  if (from === zip64 || list.byteLength < size) {
    throw new Error('the ZIP is too large or incomplete');
  }
  const entries = new Map<string, Entry>();
  for (let next = 0; next + listed.size <= size && list.getUint32(next, true) === listed.signature; ) {
    const number = (offset: number): number => list.getUint32(next + offset, true);
    const short = (offset: number): number => list.getUint16(next + offset, true);
    const name = new TextDecoder().decode(new Uint8Array(list.buffer, next + listed.size, short(28)));
    const method = short(10);
    if (short(8) & encrypted || (method !== methods.stored && method !== methods.deflated)) {
      throw new Error(`the ZIP's ${name} is encrypted, or packed with a method other than deflate`);
    }
    entries.set(name, { at: number(42), packed: number(20), size: number(24), crc: number(16), isPacked: method === methods.deflated });
    next += listed.size + short(28) + short(30) + short(32);
  }
  return entries;
}

// Hands over an entry's bytes. `taken` gets how many more bytes of the file were read. Throws an Error if the ZIP is damaged.
export async function unpack(file: File, entry: Entry, take: (bytes: Uint8Array) => void, taken: (count: number) => void): Promise<void> {
  const head = await view(file, entry.at, entry.at + header.size);
  if (head.byteLength < header.size || head.getUint32(0, true) !== header.signature) {
    throw new Error('the ZIP is damaged');
  }
  const from = entry.at + header.size + head.getUint16(26, true) + head.getUint16(28, true);
  const reader = bytesOf(file.slice(from, from + entry.packed), entry.isPacked ? 'deflate-raw' : undefined, taken);
  let [size, crc] = [0, 0];
  for (let part = await reader.read(); !part.done; part = await reader.read()) {
    size += part.value.length;
    crc = crc32(part.value, crc);
    take(part.value);
  }
  if (size !== entry.size || crc !== entry.crc) {
    throw new Error('the ZIP is damaged');
  }
}

const table = Uint32Array.from({ length: 256 }, (_, byte) => {
  let crc = byte;
  for (let bit = 0; bit < 8; bit++) crc = crc & 1 ? (crc >>> 1) ^ 0xedb88320 : crc >>> 1;
  return crc;
});

function crc32(bytes: Uint8Array, before: number): number {
  let crc = ~before;
  for (let i = 0; i < bytes.length; i++) crc = table[(crc ^ bytes[i]) & 0xff] ^ (crc >>> 8);
  return ~crc >>> 0;
}

// Returns a reader of a file's bytes, unpacked if `packing` is given. `taken` gets how many more bytes of the file were read.
export function bytesOf(file: Blob, packing: CompressionFormat | undefined, taken: (count: number) => void): ReadableStreamDefaultReader<Uint8Array> {
  const counting = new TransformStream<Uint8Array, Uint8Array>({
    transform(part, out): void {
      taken(part.length);
      out.enqueue(part);
    },
  });
  const plain = file.stream().pipeThrough(counting);
  return (packing ? plain.pipeThrough(new DecompressionStream(packing) as TransformStream) : plain).getReader();
}

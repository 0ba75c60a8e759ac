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

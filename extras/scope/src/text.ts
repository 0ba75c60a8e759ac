// Returns a name as the user meant it: without control characters, which no file takes, and at most so many UTF-16 units long, with no
// character cut in two.
export function tidied(name: string, most: number): string {
  let kept = '';
  for (const { segment } of new Intl.Segmenter().segment(name.replace(/[\s\p{Cc}]+/gu, ' ').trim())) {
    if (kept.length + segment.length > most) {
      break;
    }
    kept += segment;
  }
  return kept;
}

// Moments of a line that have a name. A recording has them as comments, which other readers skip:
//
//   # bookmarks               the ones that count follow
//   # bookmark 16120 stall    us

import { shownSeconds } from './clock';
import type { Bookmark } from './messages';
import { tidied } from './text';

export const longestName = 60; // characters
const listMost = 1 << 23; // bytes

// Returns the comments for a recording's end; '' without bookmarks.
export function commentsOf(bookmarks: readonly Bookmark[]): string {
  const lines = bookmarks.map(({ us, name }) => `# bookmark ${Math.round(shownSeconds(us / 1e6) * 1e6)} ${name}\n`);
  return lines.length > 0 ? `# bookmarks\n${lines.join('')}` : '';
}

// Returns a recording without the list of bookmarks at its end, its last line with an end. Throws if the file has changed since it was
// opened, or is gone.
export async function withoutList(file: Blob): Promise<BlobPart[]> {
  const [first, second] = new Uint8Array(await file.slice(0, 2).arrayBuffer());
  const utf16 = first === 0xff && second === 0xfe ? 'utf-16le' : first === 0xfe && second === 0xff ? 'utf-16be' : undefined;
  const plain = utf16 ? new Blob([new TextDecoder(utf16).decode(await file.arrayBuffer())]) : file;
  const tail = new TextDecoder('latin1').decode(await plain.slice(-listMost).arrayBuffer());
  const isList = (text: string): boolean => text.split(/[\r\n]+/).every((line) => line === '' || line.startsWith('# bookmark'));
  let end = tail.length;
  for (let at = tail.lastIndexOf('# bookmarks'); at >= 0 && /^[\r\n]?$/.test(tail.slice(at - 1, at)) && isList(tail.slice(at, end)); ) {
    end = at;
    at = at > 0 ? tail.lastIndexOf('# bookmarks', at - 1) : -1;
  }
  return [plain.slice(0, plain.size - (tail.length - end)), /[\r\n]$/.test(tail.slice(0, end)) ? '' : '\n'];
}

export class Bookmarks {
  all: readonly Bookmark[] = []; // in the order of their times
  private made = 0;
  private readonly unsaved = new Set<Bookmark>();

  // Another line, with these.
  enter(bookmarks: readonly Bookmark[]): void {
    this.set(bookmarks);
    this.unsaved.clear();
    this.made = bookmarks.length;
  }

  add(us: number): Bookmark {
    const bookmark = { us: Math.round(us), name: `Bookmark ${++this.made}` };
    this.set([...this.all, bookmark]);
    this.unsaved.add(bookmark);
    return bookmark;
  }

  rename(bookmark: Bookmark, name: string): void {
    bookmark.name = tidied(name, longestName);
    this.unsaved.add(bookmark);
    this.set(this.all);
  }

  remove(bookmark: Bookmark): void {
    this.set(this.all.filter((each) => each !== bookmark));
    this.unsaved.delete(bookmark);
  }

  // A file has those from a time on, or all.
  saved(fromUs = -Infinity): void {
    this.all.filter(({ us }) => us >= fromUs).forEach((bookmark) => this.unsaved.delete(bookmark));
  }

  // Returns how many, named as they are now, are in no file. `fromUs`: only those before.
  lost(fromUs = Infinity): number {
    return [...this.unsaved].filter(({ us }) => us < fromUs).length;
  }

  private set(bookmarks: readonly Bookmark[]): void {
    this.all = [...bookmarks].sort((a, b) => a.us - b.us);
  }
}

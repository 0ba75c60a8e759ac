// Moments of a line that have a name. A recording has them as comments, which other readers skip:
//
//   # bookmarks               the ones that count follow
//   # bookmark 16120 stall    us

import { shownSeconds } from './clock';
import type { Bookmark } from './messages';

export const longestName = 60; // characters

// Returns the comments for a recording's end; '' without bookmarks, unless the recording has some that are `replaced`.
export function commentsOf(bookmarks: readonly Bookmark[], replaced = false): string {
  const lines = bookmarks.map(({ us, name }) => `# bookmark ${Math.round(shownSeconds(us / 1e6) * 1e6)} ${name}\n`);
  return lines.length > 0 || replaced ? `# bookmarks\n${lines.join('')}` : '';
}

export class Bookmarks {
  all: readonly Bookmark[] = []; // in the order of their times
  private made = 0;

  // Another line, with these.
  enter(bookmarks: readonly Bookmark[]): void {
    this.set(bookmarks);
    this.made = bookmarks.length;
  }

  add(us: number): Bookmark {
    const bookmark = { us: Math.round(us), name: `Bookmark ${++this.made}` };
    this.set([...this.all, bookmark]);
    return bookmark;
  }

  rename(bookmark: Bookmark, name: string): void {
    bookmark.name = name.replace(/\s+/g, ' ').trim().slice(0, longestName);
    this.set(this.all);
  }

  remove(bookmark: Bookmark): void {
    this.set(this.all.filter((each) => each !== bookmark));
  }

  private set(bookmarks: readonly Bookmark[]): void {
    this.all = [...bookmarks].sort((a, b) => a.us - b.us);
  }
}

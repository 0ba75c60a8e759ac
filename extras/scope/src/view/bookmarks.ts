// The bookmarks of the line: set by a button or B; a card lists them, once there are some.

import { clock } from '../clock';
import { type Bookmarks, commentsOf, longestName, withoutList } from '../bookmarks';
import { byId, download, make, onKeys, setText } from '../dom';
import type { Bookmark, Problem } from '../messages';
import { RecordingSource } from '../source/recording';
import type { Source } from '../source/Source';

const listed = 100; // bookmarks: a list out of sight costs a picture as much as a row out of sight
const rowRem = 4.1; // height

export class BookmarksView {
  private readonly list = byId('bookmarks-list');
  private readonly save = byId('bookmarks-save');
  private shown?: readonly Bookmark[];
  private rows = new Map<Bookmark, HTMLElement>();
  private source?: Source;

  // `now`: the time that is shown, in us. `visit`: goes to such a time.
  constructor(
    private readonly bookmarks: Bookmarks,
    private readonly now: () => number,
    private readonly visit: (us: number) => void,
    private readonly failed: (problem: Problem) => void,
  ) {
    byId('bookmark').addEventListener('click', () => this.add());
    onKeys((key) => key === 'b' && this.add());
    this.save.addEventListener('click', () => void this.saveFile());
  }

  enter(source: Source): void {
    this.source = source;
    const { bookmarks } = source.line.file;
    this.bookmarks.enter(bookmarks ?? []);
    this.save.hidden = bookmarks === undefined;
  }

  // Call it for each picture.
  draw(): void {
    const { all } = this.bookmarks;
    if (all !== this.shown) {
      this.shown = all;
      byId('bookmarks').hidden = all.length === 0 && !this.source?.line.file.bookmarks?.length;
      this.rows = new Map(all.map((bookmark) => [bookmark, this.rows.get(bookmark) ?? this.row(bookmark)]));
      const rows = [...this.rows.values()];
      const focused = document.activeElement as HTMLElement | null;
      const lists = Array.from({ length: Math.ceil(rows.length / listed) }, (_, i) => rows.slice(i * listed, (i + 1) * listed));
      this.list.replaceChildren(...lists.map((part) => make('ol', { style: `contain-intrinsic-height: ${rowRem * part.length}rem` }, ...part)));
      if (this.list.contains(focused)) {
        focused?.focus();
      }
    }
  }

  private add(): true {
    const { us, name } = this.bookmarks.add(this.now());
    setText(byId('bookmark-announcement'), `${name} at ${clock(us)}`);
    return true;
  }

  private row(bookmark: Bookmark): HTMLElement {
    const time = clock(bookmark.us);
    const go = make('button', {}, time);
    const name = make('input', { type: 'text', value: bookmark.name, title: bookmark.name, maxlength: longestName, 'aria-label': `Name of the bookmark at ${time}` });
    const remove = make('button', { 'aria-label': `Remove the bookmark at ${time}`, title: 'Remove' }, '×');
    go.addEventListener('click', () => this.visit(bookmark.us));
    name.addEventListener('change', () => {
      this.bookmarks.rename(bookmark, name.value);
      name.value = name.title = bookmark.name;
    });
    remove.addEventListener('click', () => this.bookmarks.remove(bookmark));
    return make('li', {}, go, name, remove);
  }

  // Saves the recording that is played, with the bookmarks as they are now.
  private async saveFile(): Promise<void> {
    if (!(this.source instanceof RecordingSource)) {
      return;
    }
    const { file } = this.source;
    try {
      download(file.name, [...(await withoutList(file)), commentsOf(this.bookmarks.all)], 'text/plain');
      this.bookmarks.saved();
    } catch {
      this.failed({
        text: `${file.name} is not saved: the file has changed since it was opened, or is gone.`,
        remedy: 'Put the file back as it was, and press Save again. Until then the page keeps the bookmarks.',
      });
    }
  }
}

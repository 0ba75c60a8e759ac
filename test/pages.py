#!/usr/bin/python3
"""Reads the pages as Markdown.

pages.py commands PAGE...   prints "PAGE:LINE<tab>COMMAND" of each command that a page names: lines of fenced blocks, and inline code
pages.py dead FOLDER        prints "PAGE: TARGET" of each relative link that leads to no file or heading of FOLDER
"""
import pathlib
import re
import sys

from markdown_it import MarkdownIt

INLINE = re.compile(r"([A-Z_]+=('[^']*'|[^ ]*) )*(make|(sbus|sudo|build/[^ ]*) .+)( |$)")
PICTURE = re.compile(r'\bsrc(?:set)?="([^"]*)"')
# What a comment names: `make bench`, or FULL=1 and --baud 200000 of the line's command.
MORE = re.compile(r"make (?:-C [a-z]+ )?[a-z][a-z-]+|[A-Z_]+=(?:'[^']*'|[^ ,;)]*)|--[a-z-]+(?: [0-9]+)?")


def tokens(page):
    text = re.sub("^(<!-- from the first release|-->)$", "", pathlib.Path(page).read_text(), flags=re.M)  # README.md as it will be
    return MarkdownIt("commonmark").enable("table").parse(text)


def with_comment(lines, separator):
    """Yields (line's number, command) of lines of a command and, after the separator, a comment; indented lines continue it."""
    command = ""
    for number, line in enumerate(lines):
        comment = line
        if not line.startswith(" "):
            command, _, comment = re.split(f"({separator}|$)", line, maxsplit=1)
            yield number, command
        for more in MORE.findall(comment):
            yield number, more if more.startswith("make") else f"{command} {more}"


def commands(page):
    if page == "help":  # of make
        return with_comment(pathlib.Path(page).read_text().splitlines(), "  +")
    found = []
    for token in tokens(page):
        if token.type == "fence" and token.info not in ("cpp", "text"):
            found += [(token.map[0] + 1 + n, command) for n, command in with_comment(filter(None, token.content.splitlines()), "  +#")]
        for child in token.children or []:
            if child.type == "code_inline" and INLINE.match(child.content):
                found.append((token.map[0] if token.map else 0, child.content))
    return found


def read(page):
    """Returns the page's headings, as GitHub names them, and the targets of its links."""
    headings, targets, before = set(), [], None
    for token in tokens(page):
        if before and before.type == "heading_open":
            headings.add(re.sub(r"[^\w -]", "", "".join(child.content for child in token.children)).replace(" ", "-").lower())
        targets += [child.attrs.get("href") or child.attrs["src"] for child in token.children or [] if child.type in ("link_open", "image")]
        targets += PICTURE.findall(token.content) if token.type == "html_block" else []
        before = token
    return headings, targets


def dead(folder):
    pages = {page.resolve(): read(page) for page in pathlib.Path(folder).rglob("*.md")}
    for page, (_, targets) in pages.items():
        for target in targets:
            name, _, heading = target.partition("#")
            file = (page.parent / name).resolve() if name else page
            if not re.match("[a-z]+:", target) and not (file.exists() and (not heading or heading in pages.get(file, [()])[0])):
                print(f"{page.relative_to(pathlib.Path(folder).resolve())}: {target}")
    assert sum(len(targets) for _, targets in pages.values()) > 100


if sys.argv[1] == "dead":
    dead(sys.argv[2])
else:
    for page in sys.argv[2:]:
        for number, command in commands(page):
            print(f"{page}:{number + 1}\t{command}")

#!/bin/sh
# Builds the API reference, build/docs/html/index.html. A warning of Doxygen's is an error, and so is whatever is public
# and has no comment of its own.
#
#   sh extras/docs/api.sh
#   sh extras/docs/api.sh filter FILE   what Doxygen gets to see of a header
set -eu

# Our comments are plain ones, which Doxygen skips. Line by line they become its own, /** */ above a declaration and ///<
# behind one:
#   - The comment at the beginning of a file, above #pragma once, describes the file.
#   - One straight above a declaration describes it; but if the declaration has one behind it, the one above is the
#     heading of a group, which ends at the next empty line or closing brace.
#   - A comment in a function's body, behind a closing brace or a line of the preprocessor, or with an empty line below
#     it, describes nothing.
#   - Lines that are indented by three places or more, and no list, are shown as they stand.
filter() {
  awk '
    # Prints the comment that waits for the line below it: comment[1..count], as it stands in the file.
    function flush_plain(   i) {
      for (i = 1; i <= count; i++) print comment[i]
      count = 0
    }
    function flush_heading(   i, text, title) {
      for (i = 1; i <= count; i++) {
        text = comment[i]
        sub(/^ *\/\/ */, "", text)
        title = title (i > 1 ? " " : "") text
      }
      for (i = 1; i < count; i++) print ""  # the lines keep their numbers
      print "/** @name " title " */ /** @{ */"
      group = 1
      count = 0
    }
    function flush_description(   i, list, shown, text, out) {
      for (i = 1; i <= count; i++) {
        text = comment[i]
        sub(/^ *\/\//, "", text)
        list = text ~ /^ *- / || (list && text ~ /^  /)
        if (!shown && !list && text ~ /^   /) {
          shown = 1
          if (i > 1) out[i - 1] = out[i - 1] " @verbatim"
          else text = " @verbatim" text
        } else if (shown && text !~ /^   /) {
          shown = 0
          text = " @endverbatim" text
        }
        out[i] = text
      }
      if (shown) out[count] = out[count] " @endverbatim"
      for (i = 1; i <= count; i++) print (i == 1 ? "/**" : "") out[i] (i == count ? " */" : "")
      count = 0
    }

    # Where the comment of a line begins, or 0. What a string or a character holds is no comment.
    function comment_at(line) {
      while (match(line, /"([^"\\]|\\.)*"|'\''([^'\''\\]|\\.)*'\''/)) {
        line = substr(line, 1, RSTART - 1) substr(blanks, 1, RLENGTH) substr(line, RSTART + RLENGTH)
      }
      visible = line
      return index(line, "//")
    }

    # Which braces are open: 1 for those of a function or a value, 0 for those that hold declarations.
    function follow_braces(code,   i, c) {
      for (i = 1; i <= length(code); i++) {
        c = substr(code, i, 1)
        if (c == "{") {
          body[++depth] = code !~ /^ *(namespace|class|struct|enum|union|extern) /
          bodies += body[depth]
        } else if (c == "}") {
          bodies -= body[depth--]
        }
      }
    }

    BEGIN { blanks = sprintf("%200s", "") }
    {
      at = comment_at($0)
      code = at ? substr(visible, 1, at - 1) : visible
      if (at && code ~ /^ *$/) {
        if (at == behind) {
          sub(/\/\//, "///<")  # goes on with the one behind the line above
          print
        } else {
          comment[++count] = $0
        }
        next
      }
      was_body = bodies > 0
      follow_braces(code)
      declares = !was_body && code !~ /^ *(#|[}]|public:|protected:|private:|$)/
      described = declares && at && bodies == 0 && code !~ /[{] *$/
      if (!begun && count && /^#pragma once/) {
        flush_description()
        $0 = "/** @file */"
      } else if (!declares) {
        flush_plain()
      } else if (described && count) {
        flush_heading()
      } else {
        flush_description()
      }
      begun = 1
      behind = described ? at : 0
      if (described) $0 = substr($0, 1, at - 1) "///<" substr($0, at + 2)
      if (group && code ~ /^ *([}]|$)/) {
        $0 = "/** @} */" $0
        group = 0
      }
      print
    }
    END { flush_plain() }
  ' "$1"
}

# What Doxygen 1.9.4 does not look for: values of an enum, and namespaces (whose members it then leaves out).
undocumented() {
  awk '
    /<compounddef .*kind="namespace"/ { namespace = 1 }
    /<\/compounddef>/ { namespace = 0 }
    /<enumvalue .*prot="public"/ { value = 1 }
    /<\/enumvalue>/ { value = 0 }
    /<(compound)?name>/ {
      name = $0
      gsub(/ *<[^>]*>/, "", name)
      if (/<compoundname>/) compound = name
    }
    /<briefdescription>/ && (value || (namespace && /^    </)) {
      getline
      if (/<\/briefdescription>/) {
        print "error: " (value ? compound ": the enum value " name : "the namespace " compound) " is not documented."
        failed = 1
      }
    }
    END { exit failed }
  ' "$1"/namespace*.xml "$1"/class*.xml "$1"/struct*.xml >&2
}

if [ "${1:-}" = filter ]; then
  filter "$2"
  exit
fi

cd "$(dirname "$0")/../.."
sh extras/setup/need.sh doxygen
rm -rf build/docs
mkdir -p build/docs
doxygen extras/docs/Doxyfile
undocumented build/docs/xml
echo "build/docs/html/index.html"

# Writes prototypes of a sketch's functions above the first of them, as the Arduino IDE does: a sketch may call a function
# that is defined further down, or in another of its .ino files.
#
#   awk -f prototypes.awk sketch.i sketch.cpp     sketch.i is what the preprocessor makes of sketch.cpp
#
# As in the IDE (arduino-cli, builder/internal/preprocessor/internal/ctags) members, functions in a namespace and those with
# default arguments have none, and a prototype cannot name a type that is defined below the place of the prototypes.

# Takes the file and the line that come next from '# 12 "sketch.ino"' or '#line 12 "sketch.ino"'.
function marker() {
  match($0, /[0-9]+/)
  line = substr($0, RSTART, RLENGTH) - 1
  match($0, /".*"/)
  file = substr($0, RSTART, RLENGTH)
}

# Looks at the text between the end of a declaration and "{" or ";".
function statement(last,   open, depth, name) {
  begins[++statements] = begin
  gsub(/[ \t]+/, " ", text)
  sub(/ $/, "", text)
  texts[statements] = text
  if (last == ";" || text !~ /\)$/ || text ~ /=|operator *[^A-Za-z0-9_ ]/) return
  for (open = length(text); open > 0; open--) {
    depth += (substr(text, open, 1) == ")") - (substr(text, open, 1) == "(")
    if (depth == 0) break
  }
  name = substr(text, 1, open - 1)
  if (name !~ /[ *&>][A-Za-z_][A-Za-z0-9_]* ?$/ || name ~ /::[^ ]* ?$|[^:]:[^:]|__attribute__ ?$/) return
  sub(/ $/, "", name)
  sub(/.*[ *&>]/, "", name)
  functions = functions (functions == "" ? "" : "|") name
  kind[statements] = "function"
}

# Returns where the prototypes go: above the first function, or what hands a function to something, as "Timer timer(tick);".
function place(   i) {
  for (i = 1; i <= statements; i++) {
    if (i in kind || functions != "" && texts[i] ~ ("[&(,] ?(" functions ") ?[,)]")) return begins[i]
  }
}

# The preprocessor's output: comments, macros and "#if" are gone, and a marker says where a line comes from.
FNR == NR && /^# [0-9]+ "/ { marker(); next }
FNR == NR {
  line++
  if (file !~ /\.ino"$/ || /^#/) next
  rest = $0
  while (rest != "") {
    if (in_raw) {  # R"raw(...)raw"
      end = index(rest, ")" raw "\"")
      rest = end == 0 ? "" : substr(rest, end + length(raw) + 2)
      in_raw = end == 0
      continue
    }
    if (match(rest, /^R"[^( ]*\(/)) {
      in_raw = 1
      raw = substr(rest, 3, RLENGTH - 3)
      taken = "R"
    } else if (match(rest, /^"([^"\\]|\\.)*"/) || match(rest, /^'([^'\\]|\\.)*'/)) {
      taken = substr(rest, 1, RLENGTH)
    } else {
      RLENGTH = 1
      taken = substr(rest, 1, 1)
    }
    rest = substr(rest, RLENGTH + 1)

    if (braces == 0) parentheses += (taken == "(") - (taken == ")")
    outside = braces == 0 && parentheses == 0
    if (outside && (taken == "{" || taken == ";")) statement(taken)
    braces += (taken == "{") - (taken == "}")
    if (taken == ";" || taken == "}") {
      if (braces == 0 && parentheses == 0) text = ""
    } else if (braces == 0) {
      if (text == "") begin = line " " file
      if (text != "" || taken !~ /[ \t]/) text = text taken
    }
  }
  if (text != "") text = text " "
  next
}

# The sketch itself.
FNR == 1 { first = place() }
/^#line / { marker() }
!/^#line / && ++line " " file == first {
  for (i = 1; i <= statements; i++) {
    if (i in kind) print "#line " begins[i] "\n" texts[i] ";"
  }
  print "#line " first
}
{ print }

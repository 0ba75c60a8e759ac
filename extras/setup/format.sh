#!/bin/sh
# Formats all C++ as .clang-format says, with clang-format 14. `check`: changes nothing, and names the lines that differ.
set -u
cd "$(dirname "$0")/../.." || exit 1

for program in clang-format-14 clang-format; do
  case $($program --version 2>/dev/null) in
    *'version 14.'*)
      git ls-files -z '*.h' '*.cpp' '*.ino' | xargs -0 "$program" $([ "${1:-}" = check ] && echo --dry-run -Werror || echo -i)
      exit ;;
  esac
done
echo "clang-format 14 is needed: the package clang-format of Debian 12, clang-format-14 of Ubuntu 24.04" >&2
exit 3

#!/bin/sh
# Checks that all C++ sources are formatted as .clang-format says; with --fix, formats them.
set -eu
cd "$(dirname -- "$0")/.."

tool=${CLANG_FORMAT:-}
for candidate in clang-format-14 clang-format; do
  [ -n "$tool" ] || tool=$(command -v "$candidate" || true)
done
[ -n "$tool" ] || { echo "format: clang-format is not installed" >&2; exit 2; }

case ${1:-} in
  '') set -- --dry-run -Werror ;;
  --fix) set -- -i ;;
  *) echo "usage: cmake/format.sh [--fix]" >&2; exit 2 ;;
esac
for folder in fsm model props checker tests; do
  [ ! -d "$folder" ] || folders="${folders:-} $folder"
done
# shellcheck disable=SC2086  # the folders are words
find $folders \( -name '*.hpp' -o -name '*.cpp' \) \
  -exec "$tool" --style=file "$@" {} +

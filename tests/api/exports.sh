#!/usr/bin/env bash
# exports.sh LIBRARY SYMBOLS: the shared library shows the functions listed in SYMBOLS, and nothing
# else. A function that goes away or changes its name breaks programs: it needs a new version.
set -euo pipefail
diff <(nm -D --defined-only "$1" | awk '{ print $3 }' | LC_ALL=C sort) <(LC_ALL=C sort "$2") || {
  echo "exports.sh: < is what $1 shows, > what $2 promises" >&2
  exit 1
}

#!/usr/bin/env bash
# installed.sh BUILD_FOLDER SAMPLES MODEL: installs the library from BUILD_FOLDER, builds every
# sample against what was installed, and runs it.
set -euo pipefail
build=$1 samples=$2 model=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cmake --install "$build" --prefix "$work/panache" >"$work/install.log"
[[ -f $work/panache/share/panache/models/panache-int8.safetensors ]] || {
  echo "installed.sh: the models were not installed" >&2
  exit 1
}

for sample in one_character crowd; do
  cmake -S "$samples/$sample" -B "$work/$sample" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_PREFIX_PATH="$work/panache" >"$work/$sample.log"
  cmake --build "$work/$sample" >>"$work/$sample.log"
done
cp -r "$samples/plain_c" "$samples/common" "$work"
libraries=$(dirname "$(find "$work/panache" -name 'libpanache.so')")
PKG_CONFIG_PATH=$libraries/pkgconfig make -C "$work/plain_c" CFLAGS='-Wall -Wextra -Werror -pedantic'

export LD_LIBRARY_PATH=$libraries
"$work/one_character/one_character" "$model" old | tee "$work/old.txt"
# The last line: an old figure's head is well ahead of where it was.
read -r _ before after < <(tail -n 1 "$work/old.txt")
awk -v a="$before" -v b="$after" 'BEGIN { exit !(b > a + 3) }' || {
  echo "installed.sh: the old figure does not stoop: $before cm before, $after cm after" >&2
  exit 1
}
"$work/crowd/crowd" "$model" 100
"$work/plain_c/plain_c" "$model"

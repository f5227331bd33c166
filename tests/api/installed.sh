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

[[ -f $work/panache/share/doc/panache/LICENSE ]] || {
  echo "installed.sh: the licence was not installed" >&2
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

# The static library in projects of C alone, by CMake and by pkg-config.
mkdir "$work/c_only"
cat >"$work/c_only/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.20)
project(c_only LANGUAGES C)
find_package(Panache REQUIRED)
foreach(library panache panache_static)
  add_executable(with_\${library} $samples/plain_c/main.c)
  target_link_libraries(with_\${library} PRIVATE Panache::\${library} m)
endforeach()
END
cmake -S "$work/c_only" -B "$work/c_only/build" -DCMAKE_PREFIX_PATH="$work/panache" >"$work/c.log"
cmake --build "$work/c_only/build" >>"$work/c.log"
static_flags=$(PKG_CONFIG_PATH=$libraries/pkgconfig pkg-config --static --cflags --libs panache)
# shellcheck disable=SC2086
cc -std=c99 "$samples/plain_c/main.c" ${static_flags/-lpanache/-l:libpanache.a} \
  -o "$work/c_only/by_pkg_config"
for program in build/with_panache_static by_pkg_config; do
  "$work/c_only/$program" "$model" >"$work/c_only/$program.txt"
done

export LD_LIBRARY_PATH=$libraries
"$work/c_only/build/with_panache" "$model" >"$work/shared.txt"
cmp "$work/shared.txt" "$work/c_only/build/with_panache_static.txt"
"$work/one_character/one_character" "$model" old | tee "$work/old.txt"
# The last line: an old figure's head is well ahead of where it was.
read -r _ before after < <(tail -n 1 "$work/old.txt")
awk -v a="$before" -v b="$after" 'BEGIN { exit !(b > a + 3) }' || {
  echo "installed.sh: the old figure does not stoop: $before cm before, $after cm after" >&2
  exit 1
}
"$work/crowd/crowd" "$model" 100
"$work/plain_c/plain_c" "$model"

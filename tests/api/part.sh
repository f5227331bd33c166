#!/usr/bin/env bash
# part.sh PROJECT SAMPLES MODEL: a project of C has PROJECT as a part, by add_subdirectory. It gets the
# library under the names of an installation, and neither the program nor the tests.
set -euo pipefail
project=$1 samples=$2 model=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cat >"$work/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.25)
project(whole LANGUAGES C)
add_subdirectory($project part)
get_directory_property(definitions DIRECTORY . COMPILE_OPTIONS)
if(definitions OR CMAKE_CXX_STANDARD OR TARGET panache)
  message(FATAL_ERROR "the part has changed the whole: '\${definitions}' '\${CMAKE_CXX_STANDARD}'")
endif()
foreach(library panache panache_static)
  add_executable(with_\${library} $samples/plain_c/main.c)
  target_link_libraries(with_\${library} PRIVATE Panache::\${library} m)
endforeach()
END
launcher=$(command -v ccache || true)
cmake -G Ninja -S "$work" -B "$work/build" -DCMAKE_BUILD_TYPE=Debug \
  -DCMAKE_CXX_COMPILER_LAUNCHER="$launcher" >"$work/log"
nice cmake --build "$work/build" -j 2 >>"$work/log" || { tail -n 40 "$work/log"; exit 1; }
for library in panache panache_static; do
  "$work/build/with_$library" "$model" >"$work/$library.txt"
done
cmp "$work/panache.txt" "$work/panache_static.txt"
[[ ! -e $work/build/panache ]]

#!/usr/bin/env bash
# part.sh PROJECT SAMPLES MODEL BUILD_FOLDER: a project of C has PROJECT as a part, by
# add_subdirectory, and by FetchContent. It gets the library under the names of an installation, and
# neither the program nor the tests, and installs nothing of it. One module is compiled in the part; the C program is
# linked with the libraries of BUILD_FOLDER in their place, because all of them take minutes.
set -euo pipefail
project=$1 samples=$2 model=$3 built=$4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cat >"$work/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.25)
project(whole LANGUAGES C)
add_subdirectory($project part)
get_directory_property(definitions DIRECTORY . COMPILE_OPTIONS)
if(definitions OR CMAKE_CXX_STANDARD OR CMAKE_UNITY_BUILD OR TARGET panache)
  message(FATAL_ERROR "the part has changed the whole: '\${definitions}' '\${CMAKE_CXX_STANDARD}'")
endif()
install(FILES CMakeLists.txt DESTINATION own)
foreach(library panache panache_static)
  add_executable(with_\${library} $samples/plain_c/main.c)
  target_link_libraries(with_\${library} PRIVATE Panache::\${library} m)
endforeach()
END
cmake -G Ninja -S "$work" -B "$work/build" -DCMAKE_BUILD_TYPE=Debug >"$work/log"
cd "$work/build"
ninja panache_base >>"$work/log" || {
  tail -n 40 "$work/log"
  exit 1
}
[[ -z $(ninja -t targets all | grep '/tests/\|/apps/cli/') ]] || {
  echo "part.sh: the part has the program or the tests" >&2
  exit 1
}
cp -P "$built"/src/api/libpanache.* part/src/api/
cmake --install . --prefix "$work/prefix" >>"$work/log"
[[ $(cd "$work/prefix" && find . -type f) == ./own/CMakeLists.txt ]] || {
  echo "part.sh: the part has installed files:" >&2
  find "$work/prefix" -type f >&2
  exit 1
}
for library in panache panache_static; do
  # The commands of the program alone, without those that build the libraries.
  object=$(ninja -t targets all | grep -o "^CMakeFiles/with_$library\.dir/.*main\.c\.o")
  { ninja -t commands -s "$object"; ninja -t commands -s "with_$library"; } >"$work/commands"
  sh -e "$work/commands"
  "./with_$library" "$model" >"$work/$library.txt"
done
cmp "$work/panache.txt" "$work/panache_static.txt"

mkdir "$work/fetches"
cat >"$work/fetches/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.25)
project(fetches LANGUAGES CXX)
include(FetchContent)
FetchContent_Declare(panache SOURCE_DIR $project)
FetchContent_MakeAvailable(panache)
add_executable(with_both $samples/one_character/main.cpp)
target_link_libraries(with_both PRIVATE Panache::panache)
if(NOT TARGET Panache::panache_static)
  message(FATAL_ERROR "there is no Panache::panache_static")
endif()
END
cmake -G Ninja -S "$work/fetches" -B "$work/fetches/build" >>"$work/log"

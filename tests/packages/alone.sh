#!/usr/bin/env bash
# alone.sh PROJECT BUILD_FOLDER MODEL: the library alone (-DPANACHE_PROGRAM=OFF) looks for nothing that
# only the program needs and takes few steps to build; the static library alone, installed, is found
# by CMake and by pkg-config --static; the vcpkg port installs it where vcpkg wants it. The libraries
# of BUILD_FOLDER stand in for those that would take minutes to compile.
set -euo pipefail
project=$1 built=$2 model=$3
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "alone.sh: $*" >&2; exit 1; }

cmake -G Ninja -S "$project" -B "$work/build" -DPANACHE_PROGRAM=OFF -DBUILD_SHARED_LIBS=OFF \
  >"$work/log"
others=$(grep -iE '(cli11|assimp|rsvg|liblo|zip|onnx|protobuf|httplib|seccomp|meshopt|gtest|torch|stb)[^:]*:' \
  "$work/build/CMakeCache.txt" || true)
[[ -z $others ]] || fail "the library alone looks for: $others"
steps=$(cd "$work/build" && ninja -t commands all | wc -l)
echo "$steps commands build the library alone"
((steps <= 110)) || fail "the library alone takes $steps commands to build; expected at most 110"

# try FOLDER CMAKE_OPTIONS...: programs against the static library that is installed there.
try() {
  local folder=$1 flags
  shift
  [[ ! -e $folder/bin ]] || fail "there is a program in $folder/bin"
  [[ -z $(find "$folder" -name '*.so*') ]] || fail "the shared library is installed too"
  cmake -S "$project/samples/one_character" -B "$work/sample" "$@" >>"$work/log"
  cmake --build "$work/sample" >>"$work/log"
  "$work/sample/one_character" "$model" old >"$work/by_cmake.txt"
  ! ldd "$work/sample/one_character" | grep libpanache || fail "the sample is not linked statically"
  flags=$(PKG_CONFIG_PATH=$(dirname "$(find "$folder" -name panache.pc)") \
    pkg-config --static --cflags --libs panache)
  # shellcheck disable=SC2086
  cc -std=c99 "$project/samples/plain_c/main.c" $flags -o "$work/by_pkg_config"
  "$work/by_pkg_config" "$model" >/dev/null
  rm -rf "$work/sample"
}

cp "$built/src/api/libpanache.a" "$work/build/src/api/"
cmake --install "$work/build" --prefix "$work/prefix" >>"$work/log"
try "$work/prefix" -DCMAKE_PREFIX_PATH="$work/prefix"

# An error of the library alone is one that names what is missing.
cmake -G Ninja -S "$project" -B "$work/none" -DPANACHE_PROGRAM=OFF \
  -DCMAKE_DISABLE_FIND_PACKAGE_hwy=ON \
  >"$work/none.log" 2>&1 && fail "no error without Highway"
grep -q hwy "$work/none.log" || fail "the error without Highway does not name it"

cmake -DPORT=panache -DWORK="$work/vcpkg" -DBUILT="$built" \
  -DPORTFILE="$project/packaging/vcpkg/panache/portfile.cmake" -P "$here/vcpkg.cmake" >>"$work/log" 2>&1 ||
  { cat "$work/log"; fail "the vcpkg port fails"; }
packages=$work/vcpkg/packages
for file in include/panache/panache.hpp share/panache/PanacheConfig.cmake share/panache/usage \
  share/panache/copyright share/panache/models/panache-int8.safetensors lib/libpanache.a; do
  [[ -f $packages/$file ]] || fail "the vcpkg port does not install $file"
done
[[ ! -d $packages/lib/cmake ]] || fail "the vcpkg port leaves lib/cmake"
/usr/bin/python3 "$here/conan_test.py" "$project"

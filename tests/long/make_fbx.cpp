// make_fbx FILE: writes a walk as FBX, for starve.py.

#include <cstdio>

#include "base/file.h"
#include "clip/make_fbx.h"
#include "make_clip.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const auto written = panache::write_file(
      argv[1], panache::test::format_fbx(panache::test::walking_clip(30)), true);
  if (written) return 0;
  std::fprintf(stderr, "make_fbx: %s\n", written.error().message.c_str());
  return 1;
}

// golden MODEL: the hash of 300 styled frames on this machine, for the page to compare its own
// with.

#include <cinttypes>
#include <cstdio>

#include "golden.h"

int main(int argc, char** argv) {
  if (argc != 2) return std::fputs("usage: golden MODEL\n", stderr), 2;
  const auto model = panache::Model::load(argv[1]);
  if (!model) return std::fprintf(stderr, "%s\n", model.error().message.c_str()), 1;
  std::printf("%016" PRIx64 "\n", panache::web::golden_hash(*model));
  return 0;
}

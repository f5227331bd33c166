// golden MODEL: the hash of 300 styled frames on each instruction set of this machine that the
// kernels are compiled for, a line each: its name and the hash.

#include <cinttypes>
#include <cstdio>
#include <set>
#include <string>

#include <hwy/targets.h>

#include "golden.h"
#include "net/dense.h"

int main(int argc, char** argv) {
  if (argc != 2) return std::fputs("usage: golden MODEL\n", stderr), 2;
  const auto model = panache::Model::load(argv[1]);
  if (!model) return std::fprintf(stderr, "%s\n", model.error().message.c_str()), 1;
  const auto print = [&] {
    std::printf("%s %016" PRIx64 "\n", panache::kernel_target(), panache::web::golden_hash(*model));
  };
#ifdef HWY_COMPILE_ONLY_STATIC
  print();
#else
  std::set<std::string> seen;
  const int64_t supported = hwy::SupportedTargets();
  for (int64_t rest = supported; rest != 0; rest &= rest - 1) {
    hwy::SetSupportedTargetsForTest(rest & -rest);
    // Targets that are not compiled fall back to one that is.
    if (seen.insert(panache::kernel_target()).second) print();
  }
#endif
  return 0;
}

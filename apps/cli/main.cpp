// panache: the program. Each verb is a file of its own.

#include <string_view>

#include "option_table.h"
#include "program.h"
#include "verbs.h"

namespace panache::cli {
namespace {

void add_verbs(CLI::App& app, int& exit_code) {
#define PANACHE_ADD_VERB(name) add_##name(app, exit_code);
  PANACHE_VERBS(PANACHE_ADD_VERB)
#undef PANACHE_ADD_VERB
}

constexpr Program kPanache = {
    "panache",
    "Panache changes the style of motion: neutral motion in, the same motion in an angry, old or "
    "proud style out.",
    "panache stylize walk.bvh --style old=1 -o old.bvh", add_verbs};

}  // namespace
}  // namespace panache::cli

int main(int argc, char** argv) {
  using namespace panache::cli;
  if (argc == 3 && argv[1] == std::string_view(kPrintReference)) {
    int unused = 0;
    return print_reference(*make_app(kPanache, unused), argv[2], PANACHE_VERSION);
  }
  return run_program(kPanache, argc, argv);
}

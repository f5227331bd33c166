// panache: the program. Each verb is a file of its own.

#include <string_view>

#include "manual_page.h"
#include "messages.h"
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
  if (argc == 2 && argv[1] == std::string_view(kPrintManualPage)) {
    int unused = 0;
    print(manual_page(*make_app(kPanache, unused), PANACHE_VERSION));
    return kDone;
  }
  return run_program(kPanache, argc, argv);
}

// panache-lab: trains, evaluates and draws the models and motions of panache.

#include <string_view>

#include <unistd.h>

#include "bench/peers.h"
#include "lab_verbs.h"
#include "png.h"
#include "program.h"

namespace panache::cli {
namespace {

void add_verbs(CLI::App& app, int& exit_code) {
#define PANACHE_ADD_VERB(name) add_##name(app, exit_code);
  PANACHE_LAB_VERBS(PANACHE_ADD_VERB)
#undef PANACHE_ADD_VERB
}

constexpr Program kLaboratory = {
    "panache-lab", "The laboratory of Panache: trains, evaluates, measures and draws.",
    "panache-lab train mine.csv -o mine.safetensors", add_verbs};

}  // namespace
}  // namespace panache::cli

int main(int argc, char** argv) {
  using namespace panache::cli;
  if (argc == 3 && argv[1] == std::string_view(kPngDrawer)) return draw_png_as_child(argv[2]);
  // OpenBLAS, which libtorch loads at start-up, reads its environment before main.
  if (argc > 1 && argv[1] == std::string_view("bench") && panache::bench::set_environment()) {
    ::execv("/proc/self/exe", argv);
  }
  return run_program(kLaboratory, argc, argv);
}

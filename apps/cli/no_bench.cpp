// In the place of bench.cpp in a build for Windows.

#include "messages.h"
#include "verbs.h"

namespace panache::cli {

void add_bench(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("bench", "Measure the speed (not in this build)");
  verb->allow_extras();
  verb->callback([&exit_code] {
    exit_code = fail({"this build measures no speed; a build for Linux does"}, kBadUsage);
  });
}

}  // namespace panache::cli

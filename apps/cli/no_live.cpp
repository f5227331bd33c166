// In the place of live.cpp and send.cpp in a build without liblo and cpp-httplib.

#include "messages.h"
#include "verbs.h"

namespace panache::cli {

void add_live(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("live", "Restyle live motion (not in this build)");
  verb->allow_extras();
  verb->callback([&exit_code] {
    exit_code = fail({"this build has no live input; build with liblo-dev and libcpp-httplib-dev"},
                     kBadUsage);
  });
}

}  // namespace panache::cli

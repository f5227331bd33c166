// In the place of view.cpp in a build without cpp-httplib.

#include "messages.h"
#include "verbs.h"

namespace panache::cli {

void add_view(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("view", "Show motion in a browser (not in this build)");
  verb->allow_extras();
  verb->callback([&exit_code] {
    exit_code =
        fail({"this build has no server for the page; build with libcpp-httplib-dev, or open "
              "build/web/index.html"},
             kBadUsage);
  });
}

}  // namespace panache::cli

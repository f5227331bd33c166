// In the place of live.cpp and send.cpp in a build without liblo and cpp-httplib.

#include <memory>
#include <string>
#include <vector>

#include "messages.h"
#include "verbs.h"

namespace panache::cli {
namespace {

void add_missing(CLI::App& app, int& exit_code, const std::string& name, const std::string& help) {
  CLI::App* verb = app.add_subcommand(name, help);
  verb->allow_extras();
  verb->callback([&exit_code] {
    exit_code = fail({"this build has no live input; build with liblo-dev and libcpp-httplib-dev"},
                     kBadUsage);
  });
}

}  // namespace

void add_live(CLI::App& app, int& exit_code) {
  add_missing(app, exit_code, "live", "Restyle live motion (not in this build)");
}

void add_send(CLI::App& app, int& exit_code) {
  add_missing(app, exit_code, "send", "Play a file as a tracker (not in this build)");
}

}  // namespace panache::cli

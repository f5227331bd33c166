// In the place of export.cpp in a build without ONNX.

#include "messages.h"
#include "verbs.h"

namespace panache::cli {

void add_export(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("export", "Write a model as ONNX (not in this build)");
  verb->allow_extras();
  verb->callback([&exit_code] {
    exit_code = fail({"this build cannot write ONNX; build with libonnx-dev and libprotobuf-dev"},
                     kBadUsage);
  });
}

}  // namespace panache::cli

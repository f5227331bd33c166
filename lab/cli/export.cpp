// panache-lab export: converts a model for other frameworks.

#include <memory>
#include <string>

#include "base/file.h"
#include "messages.h"
#include "model_path.h"
#include "onnx_model.h"
#include "outputs.h"
#include "lab_verbs.h"

namespace panache::cli {
namespace {

struct ExportVerb {
  std::string model, output;
  bool force = false;
};

int run(const ExportVerb& verb) {
  if (!verb.output.ends_with(".onnx")) {
    return fail({verb.output + ": expected a name that ends in .onnx"}, kBadUsage);
  }
  need(check_output(verb.model, verb.output, verb.force));
  const std::string onnx = need(to_onnx(need(read_tensors(verb.model)), verb.model));
  need(write_file(verb.output, onnx, verb.force));
  print("exported " + verb.model + " into " + verb.output + " (" +
        fixed(static_cast<double>(onnx.size()) / 1000, 1) + " KB, opset " +
        std::to_string(kOnnxOpset) + ")\n");
  return kDone;
}

}  // namespace

void add_export(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("export", "Write a model as ONNX, for other frameworks");
  auto options = std::make_shared<ExportVerb>();
  verb->add_option("MODEL", options->model, "Model to read (.safetensors, of float weights)")
      ->required()
      ->type_name("");
  add_option(*verb, "-o,--output OUT", options->output, "File to write (.onnx)")->required();
  verb->add_flag("--force", options->force, "Overwrite the file");
  verb->footer(
      "docs/onnx.md lists inputs and outputs.\n\n"
      "Example:\n  panache-lab export model.safetensors -o model.onnx");
  verb->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace panache::cli

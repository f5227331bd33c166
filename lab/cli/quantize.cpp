// panache-lab quantize: makes an int8 model with less than half the size and evaluation time; and
// int8 styles for it.

#include <memory>
#include <string>

#include "base/file.h"
#include "learn/style_file.h"
#include "messages.h"
#include "net/layer.h"
#include "outputs.h"
#include "style/model/model.h"
#include "lab_verbs.h"

namespace panache::cli {
namespace {

struct QuantizeVerb {
  std::string model, output;
  bool force = false;
};

// The file's bytes in int8.
std::string quantize_file(const std::string& path, const std::string& bytes) {
  const TensorFile file = need(parse_safetensors(bytes, path));
  // Reports errors of a model or a style file in the usual way.
  if (is_style_file(file)) {
    need(read_style_info(file, path));
  } else {
    need(Model::parse(bytes, path));
  }
  const std::string int8 = format_safetensors(quantize(file));
  if (int8 != format_safetensors(file)) return int8;
  throw Failure{
      {path + ": is a " + (is_style_file(file) ? "style" : "model") + " with int8 weights already"},
      kBadInput};
}

int run(const QuantizeVerb& verb) {
  if (!verb.output.ends_with(".safetensors")) {
    return fail({verb.output + ": expected a name that ends in .safetensors"}, kBadUsage);
  }
  need(check_output(verb.model, verb.output, verb.force));
  const std::string bytes = need(read_file(verb.model));
  const std::string int8 = quantize_file(verb.model, bytes);
  need(write_file(verb.output, int8, verb.force));
  const auto size = [](const std::string& file) {
    return fixed(static_cast<double>(file.size()) / 1000, 1) + " KB";
  };
  print("quantized " + verb.model + " (" + size(bytes) + ") into " + verb.output + " (" +
        size(int8) + ")\n");
  return kDone;
}

}  // namespace

void add_quantize(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand(
      "quantize", "Quantize a model (or style) to int8: smaller, faster, nearly the same motion");
  auto options = std::make_shared<QuantizeVerb>();
  verb->add_option("MODEL", options->model, "Model or style file to read")
      ->required()
      ->type_name("");
  add_option(*verb, "-o,--output OUT", options->output, "File to write (.safetensors)")->required();
  verb->add_flag("--force", options->force, "Overwrite the file");
  verb->footer("Example:\n  panache-lab quantize model.safetensors -o model-int8.safetensors");
  verb->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace panache::cli

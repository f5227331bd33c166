// panache halve: a model of less than half the size, which is evaluated in less than half the time;
// and styles for it.

#include <memory>
#include <string>

#include "base/file.h"
#include "learn/style_file.h"
#include "net/half_size.h"
#include "outputs.h"
#include "report.h"
#include "style/model.h"
#include "verbs.h"

namespace panache::cli {
namespace {

struct HalveVerb {
  std::string model, output;
  bool force = false;
};

// Whatever is wrong with a model or a style file is told as everywhere.
Result<void> check(const TensorFile& file, const std::string& path, const std::string& bytes) {
  if (is_style_file(file)) {
    if (auto info = read_style_info(file, path); !info) return info.error();
  } else if (auto model = Model::parse(bytes, path); !model) {
    return model.error();
  }
  return {};
}

// The file's bytes in half size.
Result<std::string> halve(const std::string& path, const std::string& bytes) {
  Result<TensorFile> file = parse_safetensors(bytes, path);
  if (!file) return file.error();
  if (auto good = check(*file, path, bytes); !good) return good.error();
  std::string half = format_safetensors(in_half_size(*file));
  if (half != format_safetensors(*file)) return half;
  return Error{path + ": is a " + (is_style_file(*file) ? "style" : "model") +
               " of half size already"};
}

int run(const HalveVerb& verb) {
  if (!verb.output.ends_with(".safetensors")) {
    return refuse({verb.output + ": expected a name that ends in .safetensors"}, kBadUsage);
  }
  if (auto free = check_output(verb.model, verb.output, verb.force); !free) {
    return refuse(free.error(), kBadInput);
  }
  Result<std::string> bytes = read_file(verb.model);
  if (!bytes) return refuse(bytes.error(), kBadInput);
  Result<std::string> half = halve(verb.model, *bytes);
  if (!half) return refuse(half.error(), kBadInput);
  auto written = write_file(verb.output, *half, verb.force);
  if (!written) return refuse(written.error(), kBadInput);
  const auto size = [](const std::string& file) {
    return fixed(static_cast<double>(file.size()) / 1000, 1) + " KB";
  };
  print("halved " + verb.model + " (" + size(*bytes) + ") into " + verb.output + " (" +
        size(*half) + ")\n");
  return kDone;
}

}  // namespace

void add_halve(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand(
      "halve", "Make a smaller, faster model (or style) that styles nearly the same");
  auto options = std::make_shared<HalveVerb>();
  verb->add_option("MODEL", options->model, "Model or style file to read")
      ->required()
      ->type_name("");
  verb->add_option("-o,--output", options->output, "File to write (.safetensors)")
      ->required()
      ->type_name("OUT");
  verb->add_flag("--force", options->force, "Overwrite the file");
  verb->footer("Example:\n  panache halve model.safetensors -o model-half.safetensors");
  verb->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace panache::cli

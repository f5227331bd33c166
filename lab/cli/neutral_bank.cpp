// panache-lab neutral-bank: makes the reference for learning a style without a neutral clip.

#include <memory>
#include <string>
#include <vector>

#include "base/file.h"
#include "lab_verbs.h"
#include "learn/neutral_bank.h"
#include "manifests.h"
#include "messages.h"
#include "outputs.h"
#include "takes/load_takes.h"
#include "train/neutral_bank_maker.h"

namespace panache::cli {
namespace {

struct NeutralBankFlags {
  std::string output;
  std::vector<std::string> manifests;
  std::string data, licence;  // For the metadata of the bank.
  bool force = false;
};

int make(const NeutralBankFlags& options) {
  need(check_free(options.output, options.force));
  Manifests data = need(read_manifests({options.manifests, "", {}}));
  std::erase_if(data.rows, [](const ManifestRow& row) { return row.test || !row.neutral; });
  MadeBank made = make_neutral_bank(need(load_takes(data.rows, PoseLayout::positions)), 1);
  made.file.metadata["data"] = options.data;
  made.file.metadata["licence"] = options.licence;
  const std::string bytes = format_safetensors(made.file);
  need(write_file(options.output, bytes, options.force));
  print("made " + options.output + " of " + std::to_string(made.prototypes) + " prototypes from " +
        std::to_string(made.people) + " people (" +
        fixed(static_cast<double>(bytes.size()) / 1000, 0) + " KB)\n");
  return kDone;
}

}  // namespace

void add_neutral_bank(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand(
      "neutral-bank", "Make the bank of neutral motion that panache learn uses for single clips");
  auto options = std::make_shared<NeutralBankFlags>();
  verb->add_option("MANIFEST", options->manifests,
                   "Manifests with neutral takes, whose files are called PERSON_TAKE")
      ->required();
  add_option(*verb, "-o,--output OUT", options->output, "Bank to write (.safetensors)")->required();
  add_option(*verb, "--data TEXT", options->data, "Name of the data, for the bank's metadata");
  add_option(*verb, "--licence TEXT", options->licence, "Licence of the data, likewise");
  verb->add_flag("--force", options->force, "Overwrite the file");
  verb->footer("Example:\n  panache-lab neutral-bank takes.csv -o neutral.safetensors");
  verb->callback([options, &exit_code] { exit_code = make(*options); });
}

}  // namespace panache::cli

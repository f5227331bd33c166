// panache-lab train: from manifests to a model.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <optional>
#include <thread>

#include "base/file.h"
#include "base/text.h"
#include "lab_verbs.h"
#include "manifests.h"
#include "messages.h"
#include "program.h"
#include "stop_signal.h"
#include "style/model/model.h"
#include "train/checkpoint.h"
#include "train/trainer.h"

namespace panache::cli {
namespace {

struct TrainFlags {
  ManifestOptions data;
  std::string output, recipe = default_recipe().name, data_name, licence, remover_of;
  int64_t steps = 0;
  uint64_t seed = 1;
  bool force = false, json = false;
};

// The checkpoints that an interrupted training leaves, and how to resume.
std::string describe_stop(const std::string& output) {
  const std::vector<std::string> saved = find_checkpoints(output);
  if (saved.empty()) return "stopped; nothing is kept yet, and the same command starts anew";
  return "stopped; the same command goes on from the last " +
         std::string(saved.size() == 1 ? "checkpoint" : "checkpoints") + " (" +
         one_of(saved, ", ") + "); delete " + (saved.size() == 1 ? "it" : "them") +
         " to start anew";
}

// During its lifetime, Ctrl-C ends the program with a message at any point of the training:
// checkpoints are written atomically.
class StopWatch {
 public:
  explicit StopWatch(const std::string& output) {
    watch_stop_signals();
    thread_ = std::thread([this, output] {
      while (!done_) {
        if (stop_asked()) {
          print_message(describe_stop(output));
          std::_Exit(kStopped);
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
      }
    });
  }
  ~StopWatch() {
    done_ = true;
    thread_.join();
  }

 private:
  std::atomic<bool> done_ = false;
  std::thread thread_;
};

// The training data of each style.
std::string style_table(const std::vector<StyleCoverage>& styles) {
  if (styles.empty()) return "";
  size_t width = 6;
  for (const StyleCoverage& style : styles) width = std::max(width, style.style.size() + 1);
  const auto right = [](const std::string& text) {
    return std::string(text.size() < 9 ? 9 - text.size() : 1, ' ') + text;
  };
  std::string text = padded("style", width) + right("takes") + right("seconds") + right("samples");
  for (const StyleCoverage& style : styles) {
    text += "\n" + padded(style.style, width) + right(std::to_string(style.takes)) +
            right(fixed(style.seconds, 1)) + right(std::to_string(style.samples));
  }
  return text + "\n";
}

Json to_json(const std::vector<StyleCoverage>& styles) {
  Json list = Json::array();
  for (const StyleCoverage& style : styles) {
    list.push_back({{"name", style.style},
                    {"takes", style.takes},
                    {"seconds", style.seconds},
                    {"samples", style.samples}});
  }
  return list;
}

int run(const TrainFlags& options) {
  const Recipe& recipe = *find_recipe(options.recipe);
  if (!options.data.unlabelled.empty() && recipe.training.guidance.sequences == 0) {
    return fail({"--unlabelled: recipe " + options.recipe +
                 " learns from styled takes alone; leave the option out"},
                kBadInput);
  }
  const Manifests data = need(read_manifests(options.data));
  // Checks first what would make a training of minutes useless.
  need(check_free(options.output, options.force));
  need(check_files(rows_to_train_on(data.rows, data.unlabelled)));
  std::vector<std::string> left_out;
  TrainOptions train_options(recipe);
  train_options.note = [&](const std::string& line) {
    print_message(line);
    left_out.push_back(line);
  };
  for (const std::string& line : data.left_out) train_options.note(line);
  if (options.steps > 0) {
    TrainingSettings& settings = train_options.settings;
    settings.steps = options.steps;
    settings.predictor_steps = std::min(settings.predictor_steps, options.steps);
  }
  if (!options.remover_of.empty()) {
    train_options.remover_of = need(Model::load(options.remover_of));
    // Predictions need input whose style is removed first.
    train_options.settings.predictor_steps = 0;
  }
  train_options.seed = options.seed;
  train_options.data = options.data_name;
  train_options.licence = options.licence;
  train_options.checkpoint = options.output;
  std::optional<StopWatch> watch(options.output);
  const Trained trained = need(train(data.rows, data.styles, train_options, data.unlabelled));
  watch.reset();

  const std::string bytes = format_safetensors(trained.model);
  need(write_file(options.output, bytes, true));
  need(write_file(options.output + ".losses.csv", losses_csv(trained.losses), true));
  need(write_file(options.output + ".losses.svg", losses_svg(trained.losses), true));
  remove_checkpoints(options.output);
  if (options.json) {
    print(Json{{"model", options.output},
               {"bytes", bytes.size()},
               {"samples", trained.samples},
               {"styles", to_json(trained.styles)},
               {"left_out", left_out},
               {"read_seconds", trained.read_seconds},
               {"pair_seconds", trained.pair_seconds},
               {"train_seconds", trained.train_seconds},
               {"export_error", trained.export_error}});
    return kDone;
  }
  print("trained " + options.output + " (" + std::to_string(bytes.size()) + " bytes, " +
        plural(trained.styles.size(), "style") + ") on " + std::to_string(trained.samples) +
        " samples: reading " + fixed(trained.read_seconds, 1) + " s, pairing " +
        fixed(trained.pair_seconds, 1) + " s, training " + fixed(trained.train_seconds, 1) +
        " s\nlosses: " + options.output + ".losses.csv and .losses.svg; the export differs from " +
        "libtorch's forward pass by at most " + brief(trained.export_error) + "\n" +
        style_table(trained.styles));
  return kDone;
}

}  // namespace

void add_train(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<TrainFlags>();
  CLI::App* verb = app.add_subcommand("train", "Train a model on your own motion");
  add_manifest_options(*verb, options->data)->required();
  verb->add_option("-o,--output", options->output, "The model file to write")->required();
  std::vector<std::string> names;
  std::string meanings;
  for (const Recipe* recipe : recipes()) {
    names.push_back(recipe->name);
    meanings += (meanings.empty() ? "" : "; ") + names.back() + ": " + recipe->summary;
  }
  verb->add_option("--recipe", options->recipe, meanings)
      ->check(CLI::IsMember(names))
      ->capture_default_str();
  verb->add_option("--data", options->data_name, "What the data is, kept in the model's metadata");
  verb->add_option("--licence", options->licence,
                   "Licence of the data, kept in the model's metadata");
  verb->add_option("--remover-of", options->remover_of,
                   "Train the remover of this model: it takes the styles off again");
  verb->add_option("--steps", options->steps, "Steps of training instead of the recipe's own")
      ->check(in_range(1, 1000000000));
  verb->add_option("--seed", options->seed, "Seed of all random numbers")->capture_default_str();
  verb->add_flag("--force", options->force, "Overwrite the model if it exists");
  verb->add_flag("--json", options->json, "Print the result as JSON");
  verb->footer(
      "Training that Ctrl-C or a crash ends leaves checkpoints beside the model\n"
      "(OUT.*.checkpoint) and goes on from them when it is run again.\n\n"
      "Examples:\n"
      "  panache-lab train mine.csv -o mine.safetensors\n"
      "  panache-lab train mine.csv --unlabelled others.csv -o mine.safetensors");
  verb->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace panache::cli

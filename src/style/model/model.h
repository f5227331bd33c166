#pragma once
// A trained model: read-only, shared by all characters that use it.

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "net/mlp.h"
#include "pose/features.h"
#include "pose/style_delta.h"
#include "recipes/recipe.h"
#include "style/model/gesture.h"
#include "style/model/person.h"

namespace panache {

class PredictorNetwork;

// The outputs of a learnt style's head: the change, the logarithm of the rate, and offsets to the
// contact network's logits for the left and the right foot.
inline constexpr int kLearntOutputs = StyleDelta::kSize + 1 + 2;

struct StyleInfo {
  std::string name;            // "old"
  std::string description;     // What it looks like, for display.
  std::string origin;          // The source of a learnt style; empty for others.
  bool learnt = false;         // By learn_style(), on the activations of trained networks.
  std::string group = {};      // Its heading in lists, "moods"; "" if learnt or if the
                               // model names no groups.
  std::string source = {};     // The source of its motion,
  std::string licence = {};    // and its licence, for users; may be empty.
  std::string thumbnail = {};  // A picture, SVG on one line; may be empty.
  std::string side = {};       // The captured side, "right leg", see find_side(); may be empty.
  std::string words = {};      // Other words for it, separated by spaces, "elderly aged"; may be
                               // empty.
  // Gestures a second in its takes, "0.25"; empty if unknown.
  std::string gesture_rate = {};
};

class Model {
 public:
  // Reads and checks a model file; the error message says what is wrong.
  static Result<std::shared_ptr<const Model>> load(const std::string& path);
  static Result<std::shared_ptr<const Model>> parse(std::string_view bytes,
                                                    const std::string& name);
  // The same from memory. Values of `half` tensors must be representable as fp16, as in a file.
  static Result<std::shared_ptr<const Model>> create(const TensorFile& file,
                                                     const std::string& name);

  const Recipe& recipe() const { return *recipe_; }
  PoseLayout layout() const { return recipe_->layout; }
  const std::vector<StyleInfo>& styles() const { return styles_; }
  const std::map<std::string, std::string>& metadata() const { return metadata_; }
  // The index of the style called `style`; failing that, a message with the nearest names, or with
  // the groups if none is near.
  Result<int> find_style(std::string_view style) const;
  // The same, ignoring the case of A to Z if the match is unique; failing that, the first style
  // that has `style` among its words.
  Result<int> find_style_by_any_name(std::string_view style) const;
  // The gestures of a style, at most kMaxGestures; few styles have any.
  std::span<const Gesture> gestures(int style) const {
    return gestures_[static_cast<size_t>(style)];
  }
  // How many of them a second the takes of a style have; 0 if it has none or the model does not
  // say.
  float gesture_rate(int style) const { return gesture_rates_[static_cast<size_t>(style)]; }
  // Parameters of the networks, without gestures.
  size_t parameter_count() const { return parameter_count_; }
  // The predictor of missing input; null in models without one.
  const PredictorNetwork* predictor() const { return predictor_.get(); }

  // How people differ; null in models without persons.
  const PersonSpace* persons() const { return persons_ ? &*persons_ : nullptr; }

  // Whether styles can be learnt: the model knows how its activations vary.
  bool can_learn() const { return recipe_->learns_styles && !activation_mean_.empty(); }
  // Size of all hidden layers of the pose trunk together, on which styles are learnt.
  size_t activation_count() const { return trunks_.all_outputs(kPose); }
  // Their mean and deviation over motion of all kinds. [activation_count()], or empty.
  std::span<const float> activation_mean() const { return activation_mean_; }
  std::span<const float> activation_scale() const { return activation_scale_; }
  // Recognises styles from statistics of a window of motion (learn/recognise.h): mean and inverse
  // deviation of the statistics, and a layer with one output per style and, last, neutral.
  struct Recognition {
    std::vector<float> mean, factor;  // [statistics]
    PackedLayer layer;                // [statistics][styles + 1]
  };
  // Null if the model recognises none.
  const Recognition* recognition() const { return recognition_ ? &*recognition_ : nullptr; }
  // The number of statistics, see learn/recognise.h.
  size_t recognition_count() const {
    return 2 * (activation_count() + static_cast<size_t>(pose_feature_count(layout())));
  }
  // Scale of each output of the pose network.
  std::span<const float> output_scale() const { return output_scale_; }

 private:
  friend class StyleNetworks;

  // Limits for files, so that a step can work on the stack.
  static constexpr size_t kMaxInputs = 2048, kMaxUnits = 512, kMaxStyles = 255;
  static constexpr size_t kMaxActivations = 3 * kMaxUnits;
  static constexpr int kMaxReduced = 128;  // Combinations of activations that a pose head reads.
  // The maximum scratch size of a forward pass, in floats: inputs, all layers of three trunks,
  // activations in three stages of a gate, outputs of one head or of all styles' small heads.
  static constexpr size_t kMaxScratch =
      kMaxInputs + 3 * kMaxActivations + 3 * kMaxActivations + 2 * (kMaxStyles + 1);

  // Indices of the networks in trunks_ and heads_.
  enum { kPose, kTiming, kContact, kNetworks };
  // Each trunk has one head per style (preceded, in the contact network, by one for no style) or
  // one output layer for all, see Recipe::style_heads.
  struct Heads {
    size_t count = 0, outputs = 0;
    // One layer per head; or, if heads have fewer outputs than a vector has lanes, one layer with
    // the outputs of all, head after head.
    std::vector<PackedLayer> layers;
    bool joined() const { return layers.size() < count; }
  };
  // Measures how far a window is from the training data: the length of the whitened difference of
  // the pose trunk's activations from their mean. Absent (no whitening) in models of recipes
  // without learnt styles.
  struct Gate {
    std::vector<float> mean;  // [hidden]
    PackedLayer whitening;    // [hidden][directions], bias zero
    float limit = 0;          // Distance up to which the gate is fully open.
    bool present() const { return limit > 0; }
  };
  // A style learnt in closed form on the activations of all layers of the pose trunk, with a
  // separate gate that measures how far a window is from the style's examples.
  struct Learnt {
    PackedLayer head;                 // [activations][kLearntOutputs]
    std::vector<float> mean;          // Mean of its examples' activations. [activations]
    PackedLayer gate;                 // [activations][directions]: principal coordinates,
    std::vector<float> gate_weights;  // and the weight of each squared coordinate.
    float gate_residual = 0;          // Weight of a squared standardised difference from the mean.
  };
  size_t built_in() const { return styles_.size() - learnt_.size(); }
  Result<void> read_metadata(const TensorFile& file, const std::string& name);
  Result<void> read_numbers(const TensorFile& file, const std::string& name);
  Result<void> read_gate(const TensorFile& file, const std::string& name);
  Result<void> read_networks(const TensorFile& file, const std::string& name);
  Result<std::vector<int>> read_reductions(const TensorFile& file, int styles,
                                           const std::string& name);
  Result<void> read_activations(const TensorFile& file, const std::string& name);
  Result<void> read_recognition(const TensorFile& file, const std::string& name);
  static size_t count_learnt(const TensorFile& file);
  Result<void> read_learnt(const TensorFile& file, size_t count, const std::string& name);
  Result<Learnt> read_one_learnt(const TensorFile& file, const std::string& prefix,
                                 const std::string& name) const;
  Result<void> read_gestures(const TensorFile& file, const std::string& name);
  void measure_stances();
  Result<void> measure_scratch(const std::string& name);

  const Recipe* recipe_ = nullptr;
  std::vector<StyleInfo> styles_;
  std::map<std::string, std::string> metadata_;
  // For a whole window; the same for each of its poses.
  std::vector<float> input_mean_, input_factor_;  // [kWindowPoses * pose_feature_count]
  std::vector<float> output_scale_;               // [pose outputs]
  std::vector<float> output_mean_;                // Likewise; zero where Recipe::output_scale is.
  float input_clip_ = 0;                          // In deviations; infinity clips nothing.
  TrunkTrio trunks_;
  std::array<Heads, kNetworks> heads_;
  // What each pose head reads: a few combinations of the activations of all layers of the pose
  // trunk, whose mean on the style's examples is zero. Empty: heads read the last layer.
  std::vector<PackedLayer> reductions_;  // [styles], each [activations][units]
  Gate gate_;
  std::vector<float> activation_mean_, activation_scale_,
      activation_factor_;  // The last is 1 / scale.
  std::optional<Recognition> recognition_;
  std::vector<Learnt> learnt_;                  // The last styles of the list.
  std::vector<Stance> stances_;                 // [styles], or empty if unknown.
  std::vector<std::vector<Gesture>> gestures_;  // [styles]
  std::vector<float> gesture_rates_;            // [styles]
  std::optional<PersonSpace> persons_;
  std::shared_ptr<const PredictorNetwork> predictor_;
  size_t parameter_count_ = 0;
  size_t scratch_size_ = 0;  // Scratch size of one character's forward pass, see kMaxScratch.
};

// "hips spine chest ...": the canonical joints in their order, as model files carry them.
std::string canonical_joint_list();
// "6 poses 0.05 s apart", as model files carry it.
std::string window_description();

// The lines of a list in a model file's metadata.
std::vector<std::string> split_lines(std::string_view text);

// A remover is a model with styled input and neutral output: its metadata kDirection is kRemove,
// and each of its styles takes off the style of that name, kAnyStyle an unknown one.
inline constexpr const char* kDirection = "direction";
inline constexpr const char* kRemove = "remove";
inline constexpr const char* kAnyStyle = "any";

// Sides of styles. A style that was captured from one performer has a side: a limp has a leg. Side
// 1 is as captured, -1 its mirror image, and 0 the symmetric mean of both.

// Whether `phrase` can be StyleInfo::side: empty, or words of which exactly one is "left" or
// "right", such as "left leg" or "to the right".
Result<void> check_side_phrase(std::string_view phrase);

// Fails with a message if the model's styles have no sides, because they share a last layer.
Result<void> check_has_sides(const Model& model);

// The side of a style that a word names: "captured" or "mirrored", or, if StyleInfo::side tells
// what was captured, "left" or "right". Fails for other words, and as check_has_sides(). `style` is
// an index in the model.
Result<float> find_side(const Model& model, int style, std::string_view word);

}  // namespace panache

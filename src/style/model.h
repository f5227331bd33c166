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
#include "recipes/recipe.h"
#include "style/gesture.h"
#include "style/stance.h"

namespace panache {

class PredictorNetwork;

// The outputs of a learnt style's head: the change, the logarithm of the rate, and what to add
// to the contact network's answer (before it becomes a probability) for the left and the right
// foot.
inline constexpr int kLearntOutputs = StyleDelta::kSize + 1 + 2;

struct StyleInfo {
  std::string name;            // "old"
  std::string description;     // Its looks, for people.
  std::string origin;          // The source of a learnt style; empty for others.
  bool learnt = false;         // By learn_style(), from activations that other styles trained.
  std::string group = {};      // Its heading in lists, "moods"; "" for learnt ones and where the
                               // model names no groups.
  std::string source = {};     // Where its motion comes from,
  std::string licence = {};    // and under which licence it is, for those who get it; may be empty.
  std::string thumbnail = {};  // A picture as SVG in one line; may be empty.
};

class Model {
 public:
  // Reads and checks a model file; the message of a failure names what is wrong with it.
  static Result<std::shared_ptr<const Model>> load(const std::string& path);
  static Result<std::shared_ptr<const Model>> parse(std::string_view bytes,
                                                    const std::string& name);
  // The same of the file's contents in memory. Numbers of `half` tensors must be halves, as in a
  // file.
  static Result<std::shared_ptr<const Model>> create(const TensorFile& file,
                                                     const std::string& name);

  const Recipe& recipe() const { return *recipe_; }
  PoseLayout layout() const { return recipe_->layout; }
  const std::vector<StyleInfo>& styles() const { return styles_; }
  const std::map<std::string, std::string>& metadata() const { return metadata_; }
  // The index of the style called `style`; failing that, a message with the nearest names.
  Result<int> find_style(std::string_view style) const;
  // The same, in any case of the letters A to Z where that tells one style from all others.
  Result<int> find_style_in_any_case(std::string_view style) const;
  // The gestures of a style, at most kMaxGestures; few styles have any.
  std::span<const Gesture> gestures(int style) const {
    return gestures_[static_cast<size_t>(style)];
  }
  // Of the networks; gestures are no parameters.
  size_t parameter_count() const { return parameter_count_; }
  // The predictor of missing input; null in models without one.
  const PredictorNetwork* predictor() const { return predictor_.get(); }

  // Whether styles can be learnt: the model knows how its activations vary.
  bool can_learn() const { return recipe_->learns_styles && !activation_mean_.empty(); }
  // Numbers that all hidden layers of the pose trunk answer together: what styles are learnt on.
  size_t activation_count() const { return trunks_.all_outputs(kPose); }
  // Their mean and deviation over motion of all kinds. [activation_count()], or empty.
  std::span<const float> activation_mean() const { return activation_mean_; }
  std::span<const float> activation_scale() const { return activation_scale_; }
  // Tells styles from the statistics of a window of motion (learn/recognise.h): their mean and one
  // over their deviation, and a layer with an output for each style and, last, neutral.
  struct Recognition {
    std::vector<float> mean, factor;  // [statistics]
    PackedLayer layer;                // [statistics][styles + 1]
  };
  // Null where the model recognises none.
  const Recognition* recognition() const { return recognition_ ? &*recognition_ : nullptr; }
  // How many statistics there are: see learn/recognise.h.
  size_t recognition_count() const {
    return 2 * (activation_count() + static_cast<size_t>(pose_feature_count(layout())));
  }
  // Scale of each output of the pose network.
  std::span<const float> output_scale() const { return output_scale_; }

 private:
  friend class StyleNetworks;

  // A file may not exceed these, so that a step finds room for its work on the stack.
  static constexpr size_t kMaxInputs = 2048, kMaxUnits = 512, kMaxStyles = 255;
  static constexpr size_t kMaxActivations = 3 * kMaxUnits;
  // The numbers that a forward pass works in, at the most: inputs, all layers of three trunks,
  // activations on three stages of a gate, answers of one head or of all styles' small heads.
  static constexpr size_t kMaxScratch =
      kMaxInputs + 3 * kMaxActivations + 3 * kMaxActivations + 2 * (kMaxStyles + 1);

  // The networks, by their place in trunks_ and heads_.
  enum { kPose, kTiming, kContact, kNetworks };
  // On each trunk one head per style (the contact network has one for no style at all before them)
  // or one output layer for all, see Recipe::style_heads.
  struct Heads {
    size_t count = 0, outputs = 0;
    // Each head alone; or, where heads have fewer outputs than a vector has lanes, one layer with
    // the outputs of all, head after head.
    std::vector<PackedLayer> layers;
    bool joined() const { return layers.size() < count; }
  };
  // How far a window is from those that the model was trained on: the length of the whitened
  // difference of the pose trunk's activations from their mean. Absent (no whitening) in models of
  // recipes on which no style can be learnt.
  struct Gate {
    std::vector<float> mean;  // [hidden]
    PackedLayer whitening;    // [hidden][directions], bias zero
    float limit = 0;          // Distance up to which everything is trusted.
    bool present() const { return limit > 0; }
  };
  // A style learnt in closed form on the activations of all layers of the pose trunk, with a gate
  // of its own: how far a window is from those that the style was learnt from.
  struct Learnt {
    PackedLayer head;         // [activations][kLearntOutputs]
    std::vector<float> mean;  // Of the activations it was learnt from. [activations]
    PackedLayer gate;         // [activations][directions]: how far along the main directions,
    std::vector<float> gate_weights;  // and the weight of each squared coordinate beyond `rest`.
    float gate_residual = 0;          // Weight of a squared standardised difference from the mean.
  };
  size_t built_in() const { return styles_.size() - learnt_.size(); }
  Result<void> read_metadata(const TensorFile& file, const std::string& name);
  Result<void> read_numbers(const TensorFile& file, const std::string& name);
  Result<void> read_gate(const TensorFile& file, const std::string& name);
  Result<void> read_networks(const TensorFile& file, const std::string& name);
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
  // Of a whole window; the same for each of its poses.
  std::vector<float> input_mean_, input_factor_;  // [kWindowPoses * pose_feature_count]
  std::vector<float> output_scale_;               // [pose outputs]
  std::vector<float> output_mean_;                // The same; zero where Recipe::output_scale is.
  float input_clip_ = 0;                          // In deviations; infinity clips nothing.
  TrunkTrio trunks_;
  std::array<Heads, kNetworks> heads_;
  Gate gate_;
  std::vector<float> activation_mean_, activation_scale_,
      activation_factor_;  // The last is 1 / scale.
  std::optional<Recognition> recognition_;
  std::vector<Learnt> learnt_;                  // Of the last styles.
  std::vector<Stance> stances_;                 // [styles], or empty where they are not known.
  std::vector<std::vector<Gesture>> gestures_;  // [styles]
  std::shared_ptr<const PredictorNetwork> predictor_;
  size_t parameter_count_ = 0;
  size_t scratch_size_ =
      0;  // Numbers that a forward pass of one character works in, see kMaxScratch.
};

}  // namespace panache

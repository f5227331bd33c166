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

namespace panache {

// What the pose network's numbers mean once they are a change of the body: 21 rotation vectors in
// the heading frame [0..62], height of the hips [63], ground velocity left and forward [64..65],
// turn rate [66]; radians, metres, and seconds of the input (so that the way over the ground is the
// same at any tempo).
inline constexpr int kChangeNumbers = 67;
using ChangeNumbers = std::array<float, kChangeNumbers>;

enum class Recipe {
  panache,    // Style heads on the last layer; the output is a change of the input.
  smith2019,  // The style vector is an input; the output is an absolute pose.
};

struct StyleInfo {
  std::string name;         // "old"
  std::string description;  // What it looks like, for people.
};

class Model {
 public:
  // Reads and checks a model file; the sentence of a failure names what is wrong with it.
  static Result<std::shared_ptr<const Model>> load(const std::string& path);
  static Result<std::shared_ptr<const Model>> parse(std::string_view bytes,
                                                    const std::string& name);

  Recipe recipe() const { return recipe_; }
  PoseLayout layout() const { return layout_; }
  const std::vector<StyleInfo>& styles() const { return styles_; }
  const std::map<std::string, std::string>& metadata() const { return metadata_; }
  // The index of the style called `style`; failing that, a sentence with the nearest names.
  Result<int> find_style(std::string_view style) const;
  size_t parameter_count() const { return parameter_count_; }

 private:
  friend class StyleNetworks;

  // One network: a trunk, and on it one head per style (recipe panache; heads[0] is for no style at
  // all where the network has one) or one output layer (smith2019: heads[0]).
  struct Network {
    Trunk trunk;
    std::vector<DenseLayer> heads;
  };
  // How far a window is from those that the model was trained on: the length of the whitened
  // difference of the pose trunk's features from their mean. Absent (no whitening) in models of
  // recipe smith2019.
  struct Gate {
    std::vector<float> mean;  // [hidden]
    DenseLayer whitening;     // [hidden][directions], bias zero
    float limit = 0;          // Distance up to which everything is trusted.
    bool present() const { return limit > 0; }
  };
  Result<void> read_metadata(const TensorFile& file, const std::string& name);
  Result<void> read_numbers(const TensorFile& file, const std::string& name);
  Result<void> read_gate(const TensorFile& file, const std::string& name);
  Result<Network> read_network(const TensorFile& file, const std::string& prefix, int outputs,
                               int heads, const std::string& name) const;

  Recipe recipe_ = Recipe::panache;
  PoseLayout layout_ = PoseLayout::positions;
  std::vector<StyleInfo> styles_;
  std::map<std::string, std::string> metadata_;
  std::vector<float> input_mean_, input_scale_;  // [pose_numbers]; one for all six poses.
  std::vector<float> output_scale_;              // [pose outputs]
  std::vector<float> output_mean_;               // The same; smith2019 only, else zero.
  float input_clip_ = 0;                         // In deviations; 0 clips nothing.
  Network pose_, timing_, contact_;
  Gate gate_;
  size_t parameter_count_ = 0;
};

// The evaluation of a model for one character: its heads as mixed for the strengths in force.
class StyleNetworks {
 public:
  explicit StyleNetworks(std::shared_ptr<const Model> model);

  // Mixes the heads for these strengths, one per style of the model; above 1 a strength
  // counts less. Free while they stay the same.
  void set_strengths(std::span<const float> strengths) noexcept;

  // Evaluates a window as PoseHistory::window() gives it. The results stay until the next call.
  // The gate goes this share of the way from where it was to where the window wants it.
  void forward(std::span<const float> window, float gate_share = 1) noexcept;
  // How much of each style's answer to this very motion is given, beside its mean answer: 1 on most
  // motion like the training's, towards 0 on motion unlike it.
  float gate() const { return gate_; }
  // The pose network's numbers, in the model's own units undone: a change of kChangeNumbers
  // (panache) or a pose of 130 numbers (smith2019).
  std::span<const float> pose() const { return pose_out_; }
  float log_rate() const { return timing_out_[0]; }  // log of input seconds per output second.
  std::span<const float> contact() const { return contact_out_; }  // Probability per foot [2].

  const Model& model() const { return *model_; }

 private:
  struct Mixed {
    std::vector<float> weights, bias;
  };
  void mix(const Model::Network& network, bool has_base, Mixed& mixed) noexcept;
  void run(const Model::Network& network, const Mixed& mixed, std::span<float> out) noexcept;
  // Pulls the pose trunk's features towards their mean as far as the gate is closed.
  void shrink(std::span<const float> hidden, float gate_share) noexcept;

  std::shared_ptr<const Model> model_;
  std::vector<float> strengths_;
  bool mixed_ = false;
  std::vector<float> input_, scratch_;
  Mixed pose_, timing_, contact_;
  std::vector<float> pose_out_, timing_out_, contact_out_;
  float gate_ = 1;
  std::vector<float> features_, centred_, white_, no_bias_;
};

}  // namespace panache

#pragma once
// What the page shows: a source of motion, the styled character, and both as mannequins.

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "api/objects.h"
#include "recording.h"
#include "rig/body_mesh.h"
#include "rig/posed_rig.h"
#include "source.h"
#include "style/play/removal.h"
#include "style/restyle.h"

namespace panache::web {

// Maps points of the rig's file to the world:
// world = scale * rotate(to_y_up, point) - {0, floor, 0}.
struct Placement {
  Quat to_y_up;
  float scale, floor;  // Metres per file unit; metres.
};

// Where a motion takes the tempo of its styles: nowhere, where the feet step, or everywhere. See
// style_timing in panache.h.
enum class Timing { off = 0, steps = 1, all = 2 };

// The input or the output of the last step.
struct Shown {
  explicit Shown(const Source& source);
  // Updates the other members from the pose, which is shown for `seconds`.
  void update(double seconds);
  Pose pose() { return {rotations, translations}; }

  std::vector<Quat> rotations;     // [joints]
  std::vector<Vec3> translations;  // Likewise.
  // Per joint of the rig: rotation x y z w and translation, in the file's own units and axes.
  // [joints][7]
  std::vector<float> numbers;
  // The same pose as the mannequin's parts. [21][7]
  std::array<float, kMannequinNumbers> parts{};
  Mannequin mannequin;
  std::optional<Recording> recording;  // Only for the walker.
};

class Player {
 public:
  // `model` may be null: the output is the input until use_model().
  static Result<std::unique_ptr<Player>> create(std::shared_ptr<const Model> model, Source source);

  // Null without a model. Strengths, sides, person and shape are set on it.
  panache_character* character() { return character_.get(); }
  // For clips: sets keyframes for the strength of a style. Times are seconds after the first frame,
  // ascending. Without points the constant strength applies again.
  void set_track(int style, std::vector<StrengthTrack::Point> points);
  // See StylizerOptions::gesture_rate.
  void set_gesture_rate(float rate);
  // Used from the next step on; the motion continues. Initially Timing::steps.
  void set_timing(Timing timing);
  Source& source() { return source_; }
  // How firmly the left (0) or the right foot (1) stands, 0 to 1.
  float contact(size_t foot) const { return character_ ? stylizer().contacts()[foot] : 0; }
  // Input seconds per output second.
  double rate() const { return rate_ * removal_rate_; }
  // See StyleNetworks::gate(): the smaller gate of the remover and of the stylizer.
  float gate() const;

  // Sets the model that removes styles; the motion continues. Fails if the model adds styles or
  // does not suit the rig.
  Result<void> use_remover(std::shared_ptr<const Model> remover);
  // Sets the remover's style to remove from the input before others are added; -1: none, the
  // default. Eased. Ignored without a remover, and if the index is out of range.
  void set_removed(int style);

  // Switches to a new character of another model, with the shape of the old one. Fails if it does
  // not suit the rig.
  Result<void> use_model(std::shared_ptr<const Model> model);

  // Advances by `seconds` of the viewer's time, at most a tenth per call.
  void step(double seconds);
  // Steps a copy of the stylizer `count` times with the current pose, to measure its speed.
  void measure(int count);

  // The input or output of the last step.
  const Shown& shown(bool styled) const { return styled ? output_ : input_; }
  // A body with the source's proportions, for input and output; built on first use.
  const BodyMesh& body(BodyDetail detail);
  Placement placement() const;

  // The bytes of a file with this `extension` (".bvh", ".glb", ".vrma", or the clip's own): the
  // whole clip with the current settings, or the last `seconds` of a walk, at most 20. Unless
  // `styled`, exports the input.
  Result<std::string> export_as(const std::string& extension, const std::string& file_extension,
                                bool styled, double seconds) const;

 private:
  explicit Player(Source source);
  Stylizer& stylizer() const { return character_->live.stylizer(); }
  // For the current timing and gestures; sides, person and shape are those of the character.
  StylizerOptions options() const;
  // Writes the strengths at this instant to strengths_now_.
  void read_strengths();
  // All strengths that are not 0, with times of the file.
  std::vector<StrengthTrack> file_tracks() const;

  Source source_;
  std::shared_ptr<const Model> model_;
  std::unique_ptr<panache_character> character_;  // Set with a model.
  std::shared_ptr<const Model> remover_;
  std::optional<RemovalPass> removal_;  // Set with a remover.
  int removed_ = -1;
  Shown input_, output_;
  std::optional<BodyMesh> body_, coarse_body_;
  std::vector<float> strengths_now_;   // [styles]
  std::vector<StrengthTrack> tracks_;  // [styles], mostly empty.
  Timing timing_ = Timing::steps;
  float gesture_rate_ = 1;
  double rate_ = 1, removal_rate_ = 1;  // Rates of the two passes.
};

}  // namespace panache::web

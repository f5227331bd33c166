#pragma once
// What the page shows: a source of motion, the character that it moves, and both as mannequins.

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "recording.h"
#include "rig/body_mesh.h"
#include "rig/mannequin.h"
#include "source.h"
#include "style/removal_pass.h"
#include "style/restyle.h"

namespace panache::web {

// How the rig's file lies in the world: world = scale * rotate(to_y_up, point) - {0, floor, 0}.
struct Placement {
  Quat to_y_up;
  float scale, floor;  // Metres per file unit; metres.
};

// Where a motion takes the tempo of its styles: nowhere, where the feet step, or everywhere. As
// style_timing in panache.h.
enum class Timing { off = 0, steps = 1, all = 2 };

// The input, or what is made of it, at the last step.
struct Shown {
  explicit Shown(const Source& source);
  // Takes the pose that is shown for `seconds`.
  void update(double seconds);
  Pose pose() { return {rotations, translations}; }

  std::vector<Quat> rotations;     // [joints]
  std::vector<Vec3> translations;  // Likewise.
  // Per joint of the rig: rotation x y z w and translation, in the file's own units and axes.
  // [joints][7]
  std::vector<float> numbers;
  // The same as the mannequin's parts. [21][7]
  std::array<float, kMannequinNumbers> parts{};
  Mannequin mannequin;
  std::optional<Recording> recording;  // Of the walker.
};

class Player {
 public:
  static Result<std::unique_ptr<Player>> create(std::shared_ptr<const Model> model, Source source);

  // What is asked for from the next step on.
  std::vector<float>& strengths() { return strengths_; }  // [styles]
  // Of a clip: the strength of a style over time instead, seconds after the first frame, rising.
  // Without points it is the constant one again.
  void set_track(int style, std::vector<StrengthTrack::Point> points);
  Shape& shape() { return shape_; }
  // From the next step on; the motion goes on. Timing::steps at first.
  void set_timing(Timing timing);
  Source& source() { return source_; }
  const Stylizer& stylizer() const { return stylizer_; }
  // Input seconds per output second.
  double rate() const { return rate_ * removal_rate_; }
  // See StyleNetworks::gate(): the smaller one of what takes a style off and of what puts styles
  // on.
  float gate() const;

  // A model that takes styles off; the motion goes on. Fails where it puts styles on, and where the
  // rig does not suit.
  Result<void> use_remover(std::shared_ptr<const Model> remover);
  // Its style that is taken off the input before others are put on; -1: none, as at first. Eased.
  // Ignored without a remover, and for an index out of range.
  void set_removed(int style);

  // Goes on with another model: strengths are 0, without tracks. Fails where the rig does not suit.
  Result<void> use_model(std::shared_ptr<const Model> model);

  // See Stylizer::trigger().
  bool trigger(int style, int gesture) { return stylizer_.trigger(style, gesture); }

  // Goes on by `seconds` (at most a tenth is taken at once) of the viewer's time.
  void step(double seconds);
  // Steps a copy of the stylizer `count` times with the pose in force, to see how long that takes.
  void measure(int count);

  // Of the last step.
  const Shown& shown(bool styled) const { return styled ? output_ : input_; }
  // A body to the measure of the source, for both; made when it is first asked for.
  const BodyMesh& body(BodyDetail detail);
  Placement placement() const;

  // The bytes of a file of this `extension` (".bvh", ".glb", ".vrma", or that of the file that the
  // clip is from), with the whole clip restyled as is asked for now, or the last `seconds` of a
  // walk, 20 at most. Not `styled`: of the input.
  Result<std::string> export_as(const std::string& extension, const std::string& file_extension,
                                bool styled, double seconds) const;

 private:
  Player(std::shared_ptr<const Model> model, Stylizer stylizer, Source source);
  // Of the timing in force.
  StylizerOptions options() const;
  // The strengths at this instant, in strengths_now_.
  void read_strengths();
  // All that is not 0, with the times of the file.
  std::vector<StrengthTrack> file_tracks() const;

  std::shared_ptr<const Model> model_;
  Source source_;
  Stylizer stylizer_;
  std::shared_ptr<const Model> remover_;
  std::optional<RemovalPass> removal_;  // With a remover.
  int removed_ = -1;
  Shown input_, output_;
  std::optional<BodyMesh> body_, coarse_body_;
  std::vector<float> strengths_, strengths_now_;  // [styles]
  std::vector<StrengthTrack> tracks_;             // [styles], most without points.
  Shape shape_;
  Timing timing_ = Timing::steps;
  double rate_ = 1, removal_rate_ = 1;  // Of both passes.
};

}  // namespace panache::web

#pragma once
// The node PanacheCharacter: a SkeletonModifier3D that styles the pose of its skeleton in each
// frame, after the animation. The engine restores the pose afterwards, so no pose is styled twice.

#include <panache/panache.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "skeleton_pose.h"

namespace panache::godot {

class Character {
 public:
  explicit Character(Object self) : self_(self) {}

  static void register_class();
  static void unregister_class();

  // Properties: model_path, hold_feet, style_root, gestures, gesture_seed, person, variety and
  // shape/energy, and for each style of the model styles/NAME, its strength, and sides/NAME, its
  // side.
  bool set(const std::string& property, const ValueData* value);
  std::optional<Value> get(const std::string& property) const;
  std::optional<Value> initial(const std::string& property) const;
  const std::vector<Property>& properties();

  // Processes one frame, `seconds` after the last; by default the skeleton's frame time.
  void process(std::optional<double> seconds);
  // Forgets the motion so far; call it after a teleport.
  void reset_motion();

 private:
  // Backing storage for the engine's list of properties, which points into it.
  struct PropertyText {
    Name name;
    Text hint_text;
    Type type;
    uint32_t hint;
  };
  struct Destroy {
    void operator()(panache_character* character) const { panache_character_destroy(character); }
  };

  void read_model();
  void make_character(const Value& skeleton);
  // The place of a style in the model; prints an error if it has none.
  int32_t index_of(const std::string& style) const;
  void apply_strength(const std::string& style) const;
  void apply_side(const std::string& style) const;
  void apply_person();
  void apply_shape() const;
  double seconds_of(const Value& skeleton) const;

  Object self_;
  std::string model_path_;
  bool hold_feet_ = true, style_root_ = false;
  double gestures_ = 1;  // See gesture_rate in panache_character_options.
  int64_t gesture_seed_ = 0;
  std::string person_;  // A number or a word; empty: nobody.
  double variety_ = 1, energy_ = 1;
  // By style name, so they can be set before the model.
  std::map<std::string, double> strengths_, sides_;

  std::shared_ptr<panache_model> model_;
  bool told_no_persons_ = false;  // The error that the model has none, which is printed once.
  std::unique_ptr<SkeletonPose> pose_;
  std::unique_ptr<panache_character, Destroy> character_;
  // The skeleton, and the version of its bones, that pose_ and character_ were made for. Also set
  // if making them failed, so the error is printed once.
  Object of_ = nullptr;
  int64_t version_ = -1;

  std::vector<PropertyText> texts_;
  std::vector<Property> properties_;
};

}  // namespace panache::godot

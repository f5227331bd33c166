#pragma once
// The node PanacheCharacter: a SkeletonModifier3D that styles the pose of its skeleton in each
// frame, after the animation. The engine takes the pose back afterwards, so that what it plays is
// never styled twice.

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

  // Registers the class with the engine, or takes it back.
  static void register_class();
  static void unregister_class();

  // Properties: model_path, hold_feet, style_root, and styles/NAME for each style of the model.
  bool set(const std::string& property, const ValueData* value);
  std::optional<Value> get(const std::string& property) const;
  std::optional<Value> initial(const std::string& property) const;
  const std::vector<Property>& properties();

  // One frame, so many seconds after the last; without them, those of the skeleton's clock.
  void process(std::optional<double> seconds);
  // Forgets the motion so far, as after a teleport.
  void reset_motion();

 private:
  // The engine's list of properties points into it.
  struct PropertyText {
    Name name;
    Text hint;
  };
  struct Destroy {
    void operator()(panache_character* character) const { panache_character_destroy(character); }
  };

  void read_model();
  void make_character(const Value& skeleton);
  void apply(const std::string& style) const;
  double seconds_of(const Value& skeleton) const;

  Object self_;
  std::string model_path_;
  bool hold_feet_ = true, style_root_ = false;
  // By name, so that they may be set before the model is.
  std::map<std::string, double> strengths_;

  std::shared_ptr<panache_model> model_;
  std::unique_ptr<SkeletonPose> pose_;
  std::unique_ptr<panache_character, Destroy> character_;
  // Of which skeleton, and of which version of its bones, they are; also where they could not be
  // made, so that it is said once.
  Object of_ = nullptr;
  int64_t version_ = -1;

  std::vector<PropertyText> texts_;
  std::vector<Property> properties_;
};

}  // namespace panache::godot

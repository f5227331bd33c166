#pragma once
// Plays Godot for its extension: hands out the functions of the engine's C interface, with names,
// texts and values of its own behind them, and has a Skeleton3D and the nodes that the extension
// makes. What the extension makes of them is counted, so that nothing is left over.

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "interface.h"

namespace panache::godot {

struct Bone {
  std::string name;
  int64_t parent;
  Transform rest;
  Rotation rotation{0, 0, 0, 1};
  Vector position{};
};

struct Host {
  // The one skeleton, parent of every modifier.
  std::vector<Bone> bones;
  Transform at{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0}};
  int64_t version = 1, physics = 0;
  double seconds = 1.0 / 60, physics_seconds = 1.0 / 30;
  int writes = 0;  // Of poses of bones.

  std::map<std::string, std::string> files;
  std::vector<std::string> errors;
  int list_changes = 0;
  int64_t live = 0;  // Names, texts, values and bytes of the extension that are not destroyed.

  // What the extension registered.
  ClassInfo type{};
  std::string type_name, parent_name;
  std::map<std::string, MethodInfo> methods;

  // A node of that class, as the engine makes, uses and frees it.
  void* make_node();
  void free_node(void* node);
  void process(void* node);
  void process(void* node, double with_delta);  // As Godot 4.5 and newer do.
  bool set(void* node, const std::string& property, const std::string& value);
  bool set(void* node, const std::string& property, double value);
  bool set(void* node, const std::string& property, bool value);
  bool set(void* node, const std::string& property, int64_t value);
  double get_real(void* node, const std::string& property);
  bool get_flag(void* node, const std::string& property);
  std::string get_text(void* node, const std::string& property);
  bool can_revert(void* node, const std::string& property);
  std::vector<Property> properties(void* node);
  static std::string text_of(const NameData* name);
  static std::string text_of(const TextData* text);
};
extern Host host;

// The function of that name, as the extension asks for it; null for unknown ones.
void (*get_function(const char* name))();

}  // namespace panache::godot

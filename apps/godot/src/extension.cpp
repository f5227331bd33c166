// The entry point of the extension.

#include "character.h"

#if defined(_WIN32)
#define PANACHE_GODOT_API __declspec(dllexport)
#else
#define PANACHE_GODOT_API __attribute__((visibility("default")))
#endif

extern "C" PANACHE_GODOT_API panache::godot::Flag panache_godot_init(
    panache::godot::GetFunction get_function, void* library, panache::godot::Initialization* out) {
  using namespace panache::godot;
  if (!engine.load(get_function, library)) return 0;
  out->minimum_level = kSceneLevel;
  out->initialize = [](void*, int32_t level) {
    if (level == kSceneLevel) Character::register_class();
  };
  out->deinitialize = [](void*, int32_t level) {
    if (level == kSceneLevel) Character::unregister_class();
  };
  return 1;
}

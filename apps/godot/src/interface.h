#pragma once
// The part of Godot's C interface for extensions that this one uses, with the names under which the
// engine provides its functions (Godot 4.3 and newer, 64 bits, 32-bit reals). Layouts match the
// engine's; members that this extension does not use are plain pointers.

#include <cstddef>
#include <cstdint>

namespace panache::godot {

// Storage for the engine's values, with their sizes; the engine's functions make and destroy them.
struct NameData {
  void* data;
};
struct TextData {
  void* data;
};
struct BytesData {
  void* data[2];
};
struct ValueData {  // A Variant.
  alignas(8) unsigned char data[24];
};
struct Vector {
  float x, y, z;
};
struct Rotation {
  float x, y, z, w;
};
struct Transform {
  Vector rows[3];  // Rows of the basis.
  Vector origin;
};

using Object = void*;
using Flag = uint8_t;

enum class Type : int32_t {
  none = 0,
  flag = 1,
  integer = 2,
  real = 3,
  text = 4,
  vector = 9,
  rotation = 15,
  transform = 18,
  name = 21,
  object = 24,
  bytes = 29,
};

struct CallError {
  int32_t error, argument, expected;
};

// ---- Functions of the engine -------------------------------------------------------------------

using GetFunction = void (*(*)(const char* name))();
using MakeText = void (*)(void* out, const char* utf8);
using ReadText = int64_t (*)(const TextData* text, char* out, int64_t size);
using MakeValue = void (*)(ValueData* out, void* plain);
using ReadValue = void (*)(void* out, ValueData* value);
using GetMakeValue = MakeValue (*)(Type);
using GetReadValue = ReadValue (*)(Type);
using GetType = Type (*)(const ValueData* value);
using Construct = void (*)(void* out, const void* const* arguments);
using GetConstruct = Construct (*)(Type, int32_t which);
using Destroy = void (*)(void* plain);
using GetDestroy = Destroy (*)(Type);
using DestroyValue = void (*)(ValueData* value);
using CallValue = void (*)(ValueData* self, const NameData* method,
                           const ValueData* const* arguments, int64_t count, ValueData* out,
                           CallError* error);
using ByteAt = const uint8_t* (*)(const BytesData* bytes, int64_t index);
using GetMethod = const void* (*)(const NameData* type, const NameData* method, int64_t hash);
using CallMethod = void (*)(const void* method, Object self, const void* const* arguments,
                            void* out);
using ConstructObject = Object (*)(const NameData* type);
using SetInstance = void (*)(Object object, const NameData* type, void* instance);
using PrintError = void (*)(const char* description, const char* message, const char* function,
                            const char* file, int32_t line, Flag in_editor);

// ---- Classes of an extension -------------------------------------------------------------------

struct Property {
  Type type;
  NameData* name;
  NameData* class_name;
  uint32_t hint;
  TextData* hint_text;
  uint32_t usage;
};
constexpr uint32_t kHintNone = 0, kHintRange = 1, kHintFile = 13, kHintPlaceholder = 20;
constexpr uint32_t kStoredAndEdited = 2 | 4;

using Virtual = void (*)(void* instance, const void* const* arguments, void* out);

struct ClassInfo {
  Flag is_virtual, is_abstract, is_exposed, is_runtime;
  Flag (*set)(void* instance, const NameData* name, const ValueData* value);
  Flag (*get)(void* instance, const NameData* name, ValueData* out);
  const Property* (*list_properties)(void* instance, uint32_t* count);
  void (*free_properties)(void* instance, const Property* list, uint32_t count);
  Flag (*can_revert)(void* instance, const NameData* name);
  Flag (*get_revert)(void* instance, const NameData* name, ValueData* out);
  void* validate_property;
  void* notification;
  void* to_text;
  void* reference;
  void* unreference;
  Object (*create)(void* user);
  void (*free)(void* user, void* instance);
  void* recreate;
  Virtual (*get_virtual)(void* user, const NameData* name);
  void* get_virtual_data;
  void* call_virtual_with_data;
  void* get_rid;
  void* user;
};

struct MethodInfo {
  NameData* name;
  void* user;
  void (*call)(void* user, void* instance, const ValueData* const* arguments, int64_t count,
               ValueData* out, CallError* error);
  void (*call_plain)(void* user, void* instance, const void* const* arguments, void* out);
  uint32_t flags;
  Flag has_result;
  Property* result;
  int32_t result_metadata;
  uint32_t argument_count;
  Property* arguments;
  int32_t* argument_metadata;
  uint32_t default_count;
  ValueData** defaults;
};
constexpr uint32_t kNormalMethod = 1;

using RegisterClass = void (*)(void* library, const NameData* name, const NameData* parent,
                               const ClassInfo* info);
using UnregisterClass = void (*)(void* library, const NameData* name);
using RegisterMethod = void (*)(void* library, const NameData* type, const MethodInfo* info);

// ---- The entry of an extension -----------------------------------------------------------------

constexpr int32_t kSceneLevel = 2;

struct Initialization {
  int32_t minimum_level;
  void* user;
  void (*initialize)(void* user, int32_t level);
  void (*deinitialize)(void* user, int32_t level);
};

}  // namespace panache::godot

#include "host.h"

#include <cstring>
#include <set>

namespace panache::godot {

Host host;

namespace {

// Behind each handle of the extension is one of these.
using Chars = std::string;

struct Plain {  // What a value holds.
  Type type = Type::none;
  Flag flag = 0;
  int64_t integer = 0;
  double real = 0;
  Chars text;
  Vector vector{};
  Rotation rotation{};
  Transform transform{};
  Object object = nullptr;
};

Plain*& plain_of(ValueData* value) { return *reinterpret_cast<Plain**>(value->data + 8); }
const Plain& plain_of(const ValueData* value) {
  static const Plain kNone;
  Plain* found;
  std::memcpy(&found, value->data + 8, sizeof found);
  return found ? *found : kNone;
}
void put(ValueData* out, Plain plain) {
  std::memset(out, 0, sizeof *out);
  if (plain.type == Type::none) return;
  ++host.live;
  plain_of(out) = new Plain(std::move(plain));
}
void destroy_value(ValueData* value) {
  if (!plain_of(value)) return;
  --host.live;
  delete plain_of(value);
  std::memset(value, 0, sizeof *value);
}

Plain make(Type type) {
  Plain out;
  out.type = type;
  return out;
}
Plain of(int64_t integer) {
  Plain out = make(Type::integer);
  out.integer = integer;
  return out;
}
Plain of(double real) {
  Plain out = make(Type::real);
  out.real = real;
  return out;
}
Plain of_text(const Chars& text) {
  Plain out = make(Type::text);
  out.text = text;
  return out;
}

// ---- Names, texts and bytes ---------------------------------------------------------------------

void make_chars(void* out, const char* utf8) {
  void** handle = static_cast<void**>(out);
  *handle = *utf8 ? new Chars(utf8) : nullptr;  // Nothing is behind what is empty.
  if (*handle) ++host.live;
}
void destroy_chars(void* plain) {
  void** handle = static_cast<void**>(plain);
  if (*handle) --host.live;
  delete static_cast<Chars*>(*handle);
  *handle = nullptr;
}
Chars chars_of(const void* handle) {
  const void* found = *static_cast<void* const*>(handle);
  return found ? *static_cast<const Chars*>(found) : Chars();
}
int64_t read_text(const TextData* text, char* out, int64_t size) {
  const Chars chars = chars_of(text);
  if (out) std::memcpy(out, chars.data(), std::min(static_cast<size_t>(size), chars.size()));
  return static_cast<int64_t>(chars.size());
}
void copy_chars(void* out, const void* const* arguments) {
  make_chars(out, chars_of(arguments[0]).c_str());
}
void make_no_bytes(void* out, const void* const*) { std::memset(out, 0, sizeof(BytesData)); }

Construct get_construct(Type type, int32_t which) {
  if (type == Type::text && which == 2) return copy_chars;
  return type == Type::bytes && which == 0 ? make_no_bytes : nullptr;
}
Destroy get_destroy(Type) { return destroy_chars; }
const uint8_t* byte_at(const BytesData* bytes, int64_t index) {
  return static_cast<const uint8_t*>(
      static_cast<const void*>(static_cast<const Chars*>(bytes->data[0])->data() + index));
}

// ---- Values -------------------------------------------------------------------------------------

template <Type type, auto member>
void make_value(ValueData* out, void* plain) {
  Plain made = make(type);
  std::memcpy(&(made.*member), plain, sizeof(made.*member));
  put(out, made);
}
template <auto member>
void read_value(void* out, ValueData* value) {
  const Plain& plain = plain_of(static_cast<const ValueData*>(value));
  std::memcpy(out, &(plain.*member), sizeof(plain.*member));
}
template <Type type>
void make_chars_value(ValueData* out, void* plain) {
  Plain made = make(type);
  made.text = chars_of(plain);
  put(out, made);
}
void read_chars_value(void* out, ValueData* value) {
  make_chars(out, plain_of(static_cast<const ValueData*>(value)).text.c_str());
}

MakeValue get_make_value(Type type) {
  switch (type) {
    case Type::flag:
      return make_value<Type::flag, &Plain::flag>;
    case Type::integer:
      return make_value<Type::integer, &Plain::integer>;
    case Type::real:
      return make_value<Type::real, &Plain::real>;
    case Type::vector:
      return make_value<Type::vector, &Plain::vector>;
    case Type::rotation:
      return make_value<Type::rotation, &Plain::rotation>;
    case Type::object:
      return make_value<Type::object, &Plain::object>;
    case Type::text:
      return make_chars_value<Type::text>;
    case Type::bytes:
      return make_chars_value<Type::bytes>;
    default:
      return nullptr;
  }
}
ReadValue get_read_value(Type type) {
  switch (type) {
    case Type::flag:
      return read_value<&Plain::flag>;
    case Type::integer:
      return read_value<&Plain::integer>;
    case Type::real:
      return read_value<&Plain::real>;
    case Type::vector:
      return read_value<&Plain::vector>;
    case Type::rotation:
      return read_value<&Plain::rotation>;
    case Type::transform:
      return read_value<&Plain::transform>;
    case Type::object:
      return read_value<&Plain::object>;
    case Type::text:
      return read_chars_value;
    default:
      return nullptr;
  }
}
Type get_type(const ValueData* value) { return plain_of(value).type; }

// ---- Calls --------------------------------------------------------------------------------------

struct Node {
  void* instance = nullptr;
};
int skeleton_tag;

Plain of_object(Object object) {
  Plain out = make(Type::object);
  out.object = object;
  return out;
}

Plain call_skeleton(const std::string& method, const std::vector<Plain>& arguments) {
  if (method == "get_version") return of(host.version);
  if (method == "get_bone_count") return of(static_cast<int64_t>(host.bones.size()));
  if (method == "get_modifier_callback_mode_process") return of(int64_t{1} - host.physics);
  Plain out;
  if (method == "get_global_transform") {
    out = make(Type::transform);
    out.transform = host.at;
    return out;
  }
  if (arguments.empty() || arguments[0].type != Type::integer) return out;
  Bone& bone = host.bones.at(static_cast<size_t>(arguments[0].integer));
  if (method == "get_bone_name") return of_text(bone.name);
  if (method == "get_bone_parent") return of(bone.parent);
  if (method == "get_bone_rest") {
    out = make(Type::transform);
    out.transform = bone.rest;
  } else if (method == "get_bone_pose_rotation") {
    out = make(Type::rotation);
    out.rotation = bone.rotation;
  } else if (method == "get_bone_pose_position") {
    out = make(Type::vector);
    out.vector = bone.position;
  } else if (method == "set_bone_pose_rotation" && arguments.size() == 2 &&
             arguments[1].type == Type::rotation) {
    bone.rotation = arguments[1].rotation;
    ++host.writes;
  } else if (method == "set_bone_pose_position" && arguments.size() == 2 &&
             arguments[1].type == Type::vector) {
    bone.position = arguments[1].vector;
    ++host.writes;
  } else {
    host.errors.push_back("the skeleton has no method " + method);
  }
  return out;
}

Plain call_node(const std::string& method) {
  if (method == "get_skeleton") return of_object(host.bones.empty() ? nullptr : &skeleton_tag);
  if (method == "get_process_delta_time") return of(host.seconds);
  if (method == "get_physics_process_delta_time") return of(host.physics_seconds);
  if (method == "notify_property_list_changed") {
    ++host.list_changes;
  } else {
    host.errors.push_back("the node has no method " + method);
  }
  return {};
}

void call_value(ValueData* self, const NameData* name, const ValueData* const* arguments,
                int64_t count, ValueData* out, CallError* error) {
  const Plain& plain = plain_of(static_cast<const ValueData*>(self));
  const std::string method = chars_of(name);
  std::vector<Plain> given;
  for (int64_t i = 0; i < count; ++i) given.push_back(plain_of(arguments[i]));
  *error = {0, 0, 0};
  if (plain.type == Type::bytes && method == "size") {
    put(out, of(static_cast<int64_t>(plain.text.size())));
  } else if (plain.type == Type::object && plain.object == &skeleton_tag) {
    put(out, call_skeleton(method, given));
  } else {
    put(out, call_node(method));
  }
}

const void* get_method(const NameData* type, const NameData* method, int64_t hash) {
  static const int kReadFile = 0;
  const bool known = chars_of(type) == "FileAccess" && chars_of(method) == "get_file_as_bytes" &&
                     hash == 659035735;
  return known ? &kReadFile : nullptr;
}
void call_method(const void*, Object, const void* const* arguments, void* out) {
  make_chars(out, "");
  const auto file = host.files.find(chars_of(arguments[0]));
  if (file == host.files.end()) return;
  *static_cast<void**>(out) = new Chars(file->second);
  ++host.live;
}

// ---- Classes ------------------------------------------------------------------------------------

Object construct_object(const NameData* type) {
  return chars_of(type) == host.parent_name ? new Node : nullptr;
}
void set_instance(Object object, const NameData* type, void* instance) {
  if (chars_of(type) == host.type_name) static_cast<Node*>(object)->instance = instance;
}
void register_class(void*, const NameData* name, const NameData* parent, const ClassInfo* info) {
  host.type = *info;
  host.type_name = chars_of(name);
  host.parent_name = chars_of(parent);
}
void unregister_class(void*, const NameData*) { host.type_name = ""; }
void register_method(void*, const NameData*, const MethodInfo* info) {
  host.methods[chars_of(info->name)] = *info;
}
void print_error(const char* description, const char* message, const char*, const char*, int32_t,
                 Flag) {
  host.errors.push_back(std::string(description) + ": " + message);
}

// A name of the engine's own, for as long as a call.
struct Named {
  explicit Named(const std::string& text) { make_chars(&data, text.c_str()); }
  ~Named() { destroy_chars(&data); }
  NameData data;
};

bool set_property(void* node, const std::string& property, Plain plain) {
  Named name(property);
  ValueData value;
  put(&value, std::move(plain));
  const bool done = host.type.set(static_cast<Node*>(node)->instance, &name.data, &value);
  destroy_value(&value);
  return done;
}
Plain get_property(void* node, const std::string& property) {
  Named name(property);
  ValueData value{};
  host.type.get(static_cast<Node*>(node)->instance, &name.data, &value);
  const Plain out = plain_of(static_cast<const ValueData*>(&value));
  destroy_value(&value);
  return out;
}

}  // namespace

void* Host::make_node() { return type.create(type.user); }
void Host::free_node(void* node) {
  type.free(type.user, static_cast<Node*>(node)->instance);
  delete static_cast<Node*>(node);
}
void Host::process(void* node) {
  Named name("_process_modification");
  type.get_virtual(type.user, &name.data)(static_cast<Node*>(node)->instance, nullptr, nullptr);
}
void Host::process(void* node, double with_delta) {
  Named name("_process_modification_with_delta");
  const void* arguments[] = {&with_delta};
  type.get_virtual(type.user, &name.data)(static_cast<Node*>(node)->instance, arguments, nullptr);
}
bool Host::set(void* node, const std::string& property, const std::string& value) {
  return set_property(node, property, of_text(value));
}
bool Host::set(void* node, const std::string& property, double value) {
  return set_property(node, property, of(value));
}
bool Host::set(void* node, const std::string& property, bool value) {
  Plain plain = make(Type::flag);
  plain.flag = value;
  return set_property(node, property, plain);
}
bool Host::set(void* node, const std::string& property, int64_t value) {
  return set_property(node, property, of(value));
}
double Host::get_real(void* node, const std::string& property) {
  return get_property(node, property).real;
}
bool Host::get_flag(void* node, const std::string& property) {
  return get_property(node, property).flag != 0;
}
std::string Host::get_text(void* node, const std::string& property) {
  return get_property(node, property).text;
}
bool Host::can_revert(void* node, const std::string& property) {
  Named name(property);
  return type.can_revert(static_cast<Node*>(node)->instance, &name.data) != 0;
}
std::vector<Property> Host::properties(void* node) {
  uint32_t count = 0;
  void* instance = static_cast<Node*>(node)->instance;
  const Property* list = type.list_properties(instance, &count);
  const std::vector<Property> out(list, list + count);
  type.free_properties(instance, list, count);
  return out;
}
std::string Host::text_of(const NameData* name) { return chars_of(name); }
std::string Host::text_of(const TextData* text) { return chars_of(text); }

void (*get_function(const char* name))() {
  using Any = void (*)();
  const auto any = [](auto* function) { return reinterpret_cast<Any>(function); };
  static const std::map<std::string, Any> kFunctions = {
      {"string_name_new_with_utf8_chars", any(make_chars)},
      {"string_new_with_utf8_chars", any(make_chars)},
      {"string_to_utf8_chars", any(read_text)},
      {"get_variant_from_type_constructor", any(get_make_value)},
      {"get_variant_to_type_constructor", any(get_read_value)},
      {"variant_get_type", any(get_type)},
      {"variant_get_ptr_constructor", any(get_construct)},
      {"variant_get_ptr_destructor", any(get_destroy)},
      {"variant_destroy", any(destroy_value)},
      {"variant_call", any(call_value)},
      {"packed_byte_array_operator_index_const", any(byte_at)},
      {"classdb_get_method_bind", any(get_method)},
      {"object_method_bind_ptrcall", any(call_method)},
      {"classdb_construct_object", any(construct_object)},
      {"object_set_instance", any(set_instance)},
      {"print_error_with_message", any(print_error)},
      {"classdb_register_extension_class3", any(register_class)},
      {"classdb_unregister_extension_class", any(unregister_class)},
      {"classdb_register_extension_class_method", any(register_method)},
  };
  const auto found = kFunctions.find(name);
  return found == kFunctions.end() ? nullptr : found->second;
}

}  // namespace panache::godot

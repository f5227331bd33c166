#include "engine.h"

#include <cstring>

namespace panache::godot {

Engine engine;

bool Engine::load(GetFunction get_function, void* its_library) {
  library = its_library;
  bool all = true;
  const auto get = [&](auto& function, const char* name) {
    const auto found = get_function(name);
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(found);
    all = all && found;
  };
  get(make_name, "string_name_new_with_utf8_chars");
  get(make_text, "string_new_with_utf8_chars");
  get(read_text, "string_to_utf8_chars");
  get(get_make_value, "get_variant_from_type_constructor");
  get(get_read_value, "get_variant_to_type_constructor");
  get(get_type, "variant_get_type");
  get(get_construct, "variant_get_ptr_constructor");
  get(get_destroy, "variant_get_ptr_destructor");
  get(destroy_value, "variant_destroy");
  get(call_value, "variant_call");
  get(byte_at, "packed_byte_array_operator_index_const");
  get(get_method, "classdb_get_method_bind");
  get(call_method, "object_method_bind_ptrcall");
  get(construct_object, "classdb_construct_object");
  get(set_instance, "object_set_instance");
  get(print_error, "print_error_with_message");
  get(register_class, "classdb_register_extension_class3");
  get(unregister_class, "classdb_unregister_extension_class");
  get(register_method, "classdb_register_extension_class_method");
  return all;
}

// ---- Names and text -----------------------------------------------------------------------------

namespace {

std::string take_utf8(TextData text) {
  std::string out(static_cast<size_t>(engine.read_text(&text, nullptr, 0)), '\0');
  engine.read_text(&text, out.data(), static_cast<int64_t>(out.size()));
  engine.get_destroy(Type::text)(&text);
  return out;
}

}  // namespace

std::string to_utf8(const NameData* name) {
  constexpr int32_t kFromName = 2;  // Index of the constructor of String.
  TextData text;
  const void* arguments[] = {name};
  engine.get_construct(Type::text, kFromName)(&text, arguments);
  return take_utf8(text);
}

// ---- Values -------------------------------------------------------------------------------------

Value::Value() : data_{} {}
Value::Value(Type type, void* plain) { engine.get_make_value(type)(&data_, plain); }
Value::Value(bool flag) {
  Flag plain = flag;
  engine.get_make_value(Type::flag)(&data_, &plain);
}
Value::Value(int64_t integer) : Value(Type::integer, &integer) {}
Value::Value(double real) : Value(Type::real, &real) {}
Value::Value(const char* text) {
  Text plain(text);
  engine.get_make_value(Type::text)(&data_, plain.get());
}
Value::Value(Vector vector) : Value(Type::vector, &vector) {}
Value::Value(Rotation rotation) : Value(Type::rotation, &rotation) {}
Value::Value(Object object) : Value(Type::object, &object) {}
Value::Value(Value&& other) noexcept : data_(other.data_) { other.data_ = {}; }
Value::~Value() { engine.destroy_value(&data_); }

Value Value::call_with(const Name& method, const ValueData* const* arguments, int64_t count) const {
  Value out;
  CallError error{};
  ValueData self = data_;  // The engine does not change the object.
  engine.call_value(&self, method.get(), arguments, count, &out.data_, &error);
  return out;
}

ValueData Value::release() {
  const ValueData out = data_;
  data_ = {};
  return out;
}

namespace {

template <class Plain>
Plain read_as(Type type, const ValueData* value) {
  Plain out{};
  ValueData same = *value;  // The engine only reads it.
  if (engine.get_type(value) == type) engine.get_read_value(type)(&out, &same);
  return out;
}

}  // namespace

bool to_flag(const ValueData* value) { return read_as<Flag>(Type::flag, value) != 0; }
int64_t to_integer(const ValueData* value) { return read_as<int64_t>(Type::integer, value); }
double to_real(const ValueData* value) {
  if (engine.get_type(value) == Type::integer) return static_cast<double>(to_integer(value));
  return read_as<double>(Type::real, value);
}
std::string to_utf8(const ValueData* value) {
  if (engine.get_type(value) != Type::text) return "";
  return take_utf8(read_as<TextData>(Type::text, value));
}
Vector to_vector(const ValueData* value) { return read_as<Vector>(Type::vector, value); }
Rotation to_rotation(const ValueData* value) { return read_as<Rotation>(Type::rotation, value); }
Transform to_transform(const ValueData* value) {
  return read_as<Transform>(Type::transform, value);
}
Object to_object(const ValueData* value) { return read_as<Object>(Type::object, value); }

// ---- Files and messages -------------------------------------------------------------------------

std::vector<uint8_t> read_file(const std::string& path) {
  constexpr int64_t kHash = 659035735;  // The method's signature, in all of Godot 4.
  const void* method =
      engine.get_method(Name("FileAccess").get(), Name("get_file_as_bytes").get(), kHash);
  if (!method) return {};
  BytesData bytes;
  engine.get_construct(Type::bytes, 0)(&bytes, nullptr);
  Text text(path.c_str());
  const void* arguments[] = {text.get()};
  engine.call_method(method, nullptr, arguments, &bytes);
  ValueData value;
  engine.get_make_value(Type::bytes)(&value, &bytes);
  CallError error{};
  ValueData size;
  engine.call_value(&value, Name("size").get(), nullptr, 0, &size, &error);
  std::vector<uint8_t> out(static_cast<size_t>(to_integer(&size)));
  if (!out.empty()) std::memcpy(out.data(), engine.byte_at(&bytes, 0), out.size());
  engine.destroy_value(&size);
  engine.destroy_value(&value);
  engine.get_destroy(Type::bytes)(&bytes);
  return out;
}

void tell(const std::string& message) {
  engine.print_error("Panache", message.c_str(), "PanacheCharacter", "panache", 0, 1);
}

}  // namespace panache::godot

#pragma once
// The engine's functions, and its values with C++ lifetimes.

#include <string>
#include <string_view>
#include <vector>

#include "interface.h"

namespace panache::godot {

// The engine's functions. load() fills it once, before anything else here is used.
struct Engine {
  void* library;
  MakeText make_name, make_text;
  ReadText read_text;
  GetMakeValue get_make_value;
  GetReadValue get_read_value;
  GetType get_type;
  GetConstruct get_construct;
  GetDestroy get_destroy;
  DestroyValue destroy_value;
  CallValue call_value;
  ByteAt byte_at;
  GetMethod get_method;
  CallMethod call_method;
  ConstructObject construct_object;
  SetInstance set_instance;
  PrintError print_error;
  RegisterClass register_class;
  UnregisterClass unregister_class;
  RegisterMethod register_method;

  // Returns whether the engine has all of them.
  bool load(GetFunction get_function, void* its_library);
};
extern Engine engine;

// A StringName or a String.
template <class Data, Type kType, MakeText Engine::*kMake>
class Owned {
 public:
  explicit Owned(const char* utf8) { (engine.*kMake)(&data_, utf8); }
  Owned(Owned&& other) noexcept : data_(other.data_) { other.data_.data = nullptr; }
  Owned& operator=(Owned&&) = delete;
  ~Owned() {
    if (data_.data) engine.get_destroy(kType)(&data_);
  }
  const Data* get() const { return &data_; }
  Data* get() { return &data_; }

 private:
  Data data_;
};
using Name = Owned<NameData, Type::name, &Engine::make_name>;
using Text = Owned<TextData, Type::text, &Engine::make_text>;
std::string to_utf8(const NameData* name);

// A Variant.
class Value {
 public:
  Value();
  explicit Value(bool flag);
  explicit Value(int64_t integer);
  explicit Value(double real);
  explicit Value(const char* text);
  explicit Value(Vector vector);
  explicit Value(Rotation rotation);
  explicit Value(Object object);
  Value(Value&& other) noexcept;
  Value& operator=(Value&&) = delete;
  ~Value();

  // Calls a method of this object. Returns nil if the engine rejects the call.
  template <class... Arguments>
  Value call(const Name& method, const Arguments&... arguments) const {
    const ValueData* list[] = {arguments.get()..., nullptr};
    return call_with(method, list, sizeof...(arguments));
  }
  // Passes ownership of the value to the engine.
  ValueData release();
  const ValueData* get() const { return &data_; }

 private:
  Value(Type type, void* plain);
  Value call_with(const Name& method, const ValueData* const* arguments, int64_t count) const;
  ValueData data_;
};

// The content of a value, or 0 if it has another type.
bool to_flag(const ValueData* value);
int64_t to_integer(const ValueData* value);
double to_real(const ValueData* value);  // Accepts integers too.
std::string to_utf8(const ValueData* value);
Vector to_vector(const ValueData* value);
Rotation to_rotation(const ValueData* value);
Transform to_transform(const ValueData* value);
Object to_object(const ValueData* value);

// The bytes of a file (res:// or any other path); empty if it cannot be read.
std::vector<uint8_t> read_file(const std::string& path);

// Prints an error in the console and the editor.
void tell(const std::string& message);

}  // namespace panache::godot

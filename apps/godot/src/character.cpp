#include "character.h"

#include <algorithm>

namespace panache::godot {
namespace {

// Created when the class is registered; must be released before the engine exits.
struct Shared {
  Names names;
  Name class_name{"PanacheCharacter"}, parent_name{"SkeletonModifier3D"}, no_name{""};
  std::map<std::string, std::weak_ptr<panache_model>> models;  // By path.
};
std::unique_ptr<Shared> shared;

constexpr std::string_view kStyles = "styles/", kSides = "sides/";

// The style whose strength (kStyles) or side (kSides) a property holds; empty for other properties.
std::string style_of(const std::string& property, std::string_view kind) {
  return property.starts_with(kind) ? property.substr(kind.size()) : "";
}

// The text without the space around it.
std::string trimmed(const std::string& text) {
  constexpr const char* kSpace = " \t\r\n";
  const size_t begin = text.find_first_not_of(kSpace);
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(kSpace) - begin + 1);
}

}  // namespace

// ---- Properties ---------------------------------------------------------------------------------

bool Character::set(const std::string& property, const ValueData* value) {
  if (const std::string style = style_of(property, kStyles); !style.empty()) {
    strengths_[style] = to_real(value);
    if (character_) apply_strength(style);
    return true;
  }
  if (const std::string style = style_of(property, kSides); !style.empty()) {
    sides_[style] = to_real(value);
    if (character_) apply_side(style);
    return true;
  }
  if (property == "person") {
    // Scripts may set a number.
    person_ = engine.get_type(value) == Type::integer ? std::to_string(to_integer(value))
                                                      : to_utf8(value);
    if (character_) apply_person();
    return true;
  }
  if (property == "variety") {
    variety_ = to_real(value);
    if (character_) apply_person();
    return true;
  }
  if (property == "shape/energy") {
    energy_ = to_real(value);
    if (character_) apply_shape();
    return true;
  }
  if (property == "model_path") {
    model_path_ = to_utf8(value);
    read_model();
  } else if (property == "hold_feet") {
    hold_feet_ = to_flag(value);
  } else if (property == "style_root") {
    style_root_ = to_flag(value);
  } else if (property == "gestures") {
    gestures_ = to_real(value);
  } else if (property == "gesture_seed") {
    gesture_seed_ = to_integer(value);
  } else {
    return false;
  }
  of_ = nullptr;  // Recreates the character.
  return true;
}

std::optional<Value> Character::get(const std::string& property) const {
  const auto number = [](const auto& numbers, const std::string& style, double initial) {
    const auto found = numbers.find(style);
    return Value(found == numbers.end() ? initial : found->second);
  };
  if (const std::string style = style_of(property, kStyles); !style.empty()) {
    return number(strengths_, style, 0);
  }
  if (const std::string style = style_of(property, kSides); !style.empty()) {
    return number(sides_, style, 1);
  }
  if (property == "model_path") return Value(model_path_.c_str());
  if (property == "hold_feet") return Value(hold_feet_);
  if (property == "style_root") return Value(style_root_);
  if (property == "gestures") return Value(gestures_);
  if (property == "gesture_seed") return Value(gesture_seed_);
  if (property == "person") return Value(person_.c_str());
  if (property == "variety") return Value(variety_);
  if (property == "shape/energy") return Value(energy_);
  return std::nullopt;
}

std::optional<Value> Character::initial(const std::string& property) const {
  return Character(nullptr).get(property);
}

const std::vector<Property>& Character::properties() {
  texts_.clear();
  properties_.clear();
  const auto add = [&](const std::string& name, Type type, uint32_t hint = kHintNone,
                       const char* hint_text = "") {
    texts_.push_back({Name(name.c_str()), Text(hint_text), type, hint});
  };
  add("model_path", Type::text, kHintFile, "*.safetensors");
  add("hold_feet", Type::flag);
  add("style_root", Type::flag);
  add("gestures", Type::real, kHintRange, "0,2,0.01");
  add("gesture_seed", Type::integer);
  add("person", Type::text, kHintPlaceholder, "A number or a word");
  add("variety", Type::real, kHintRange, "0,2,0.01");
  add("shape/energy", Type::real, kHintRange, "0,2,0.01");
  for (const auto& [kind, range] : {std::pair{kStyles, "-1,2,0.01"}, {kSides, "-1,1,0.01"}}) {
    for (int32_t i = 0; model_ && i < panache_model_style_count(model_.get()); ++i) {
      add(std::string(kind) + panache_model_style_name(model_.get(), i), Type::real, kHintRange,
          range);
    }
  }
  for (PropertyText& text : texts_) {
    properties_.push_back({text.type, text.name.get(), shared->no_name.get(), text.hint,
                           text.hint_text.get(), kStoredAndEdited});
  }
  return properties_;
}

void Character::read_model() {
  model_.reset();
  character_.reset();
  told_no_persons_ = false;
  if (!model_path_.empty()) {
    std::weak_ptr<panache_model>& known = shared->models[model_path_];
    model_ = known.lock();
    if (!model_) {
      const std::vector<uint8_t> bytes = read_file(model_path_);
      panache_model* made = nullptr;
      if (bytes.empty()) {
        tell(model_path_ + ": there is no such file, or it is empty");
      } else if (panache_model_create(bytes.data(), bytes.size(), &made) != PANACHE_OK) {
        tell(model_path_ + ": " + panache_last_error());
      } else {
        known = model_ = {made, panache_model_destroy};
      }
    }
  }
  Value(self_).call(shared->names.notify_property_list_changed);
}

// ---- Frames -------------------------------------------------------------------------------------

void Character::make_character(const Value& skeleton) {
  character_.reset();
  pose_ = std::make_unique<SkeletonPose>(shared->names, skeleton);
  if (!pose_->skeleton()) return tell(pose_->error());
  panache_character_options options = PANACHE_CHARACTER_OPTIONS;
  options.hold_feet = hold_feet_;
  options.style_root = style_root_;
  options.gesture_rate = static_cast<float>(gestures_);
  options.gesture_seed = static_cast<uint32_t>(gesture_seed_);
  panache_character* made = nullptr;
  if (panache_character_create(model_.get(), pose_->skeleton(), &options, &made) != PANACHE_OK) {
    return tell(panache_last_error());
  }
  character_.reset(made);
  for (const auto& [style, strength] : strengths_) apply_strength(style);
  for (const auto& [style, side] : sides_) apply_side(style);
  apply_person();
  apply_shape();
}

int32_t Character::index_of(const std::string& style) const {
  const int32_t index = panache_model_find_style(model_.get(), style.c_str());
  if (index < 0) tell(panache_last_error());
  return index;
}

void Character::apply_strength(const std::string& style) const {
  panache_character_set_strength(character_.get(), index_of(style),
                                 static_cast<float>(strengths_.at(style)));
}

void Character::apply_side(const std::string& style) const {
  panache_character_set_side(character_.get(), index_of(style),
                             static_cast<float>(sides_.at(style)));
}

void Character::apply_person() {
  const std::string person = trimmed(person_);
  if (panache_model_person_axis_count(model_.get()) == 0) {
    if (person.empty() || told_no_persons_) return;
    told_no_persons_ = true;
  }
  const double amount = person.empty() ? 0 : std::clamp(variety_, 0.0, 2.0);
  if (panache_character_set_person(character_.get(), panache_person_seed(person.c_str()),
                                   static_cast<float>(amount)) != PANACHE_OK) {
    tell(panache_last_error());
  }
}

void Character::apply_shape() const {
  panache_shape shape = PANACHE_SHAPE;
  shape.energy = static_cast<float>(energy_);
  panache_character_set_shape(character_.get(), &shape);
}

// The skeleton's setting says when its modifiers run: 0 in physics frames, else in drawn frames.
double Character::seconds_of(const Value& skeleton) const {
  const Names& names = shared->names;
  const bool physics =
      to_integer(skeleton.call(names.get_modifier_callback_mode_process).get()) == 0;
  return to_real(
      Value(self_)
          .call(physics ? names.get_physics_process_delta_time : names.get_process_delta_time)
          .get());
}

void Character::process(std::optional<double> seconds) {
  const Names& names = shared->names;
  const Value skeleton = Value(self_).call(names.get_skeleton);
  const Object node = to_object(skeleton.get());
  if (!node || !model_) return;
  const int64_t version = to_integer(skeleton.call(names.get_version).get());
  if (node != of_ || version != version_) {
    of_ = node;
    version_ = version;
    make_character(skeleton);
  }
  if (!character_) return;
  panache_character_step(character_.get(), pose_->read(names, skeleton),
                         seconds ? *seconds : seconds_of(skeleton), pose_->out());
  pose_->write(names, skeleton);
}

void Character::reset_motion() {
  if (character_) panache_character_reset(character_.get());
}

// ---- Registration -------------------------------------------------------------------------------

namespace {

Character& at(void* instance) { return *static_cast<Character*>(instance); }

Flag give(std::optional<Value> value, ValueData* out) {
  if (value) *out = value->release();
  return value.has_value();
}

Object create(void*) {
  const Object object = engine.construct_object(shared->parent_name.get());
  engine.set_instance(object, shared->class_name.get(), new Character(object));
  return object;
}

// Godot 4.5 and newer call the method that passes the time; 4.3 and 4.4 only have the other.
Virtual find_virtual(void*, const NameData* name) {
  const std::string method = to_utf8(name);
  if (method == "_process_modification_with_delta") {
    return [](void* instance, const void* const* arguments, void*) {
      at(instance).process(*static_cast<const double*>(arguments[0]));
    };
  }
  if (method != "_process_modification") return nullptr;
  return [](void* instance, const void* const*, void*) { at(instance).process(std::nullopt); };
}

}  // namespace

void Character::register_class() {
  shared = std::make_unique<Shared>();
  ClassInfo info{};
  info.is_exposed = 1;
  info.set = [](void* instance, const NameData* name, const ValueData* value) -> Flag {
    return at(instance).set(to_utf8(name), value);
  };
  info.get = [](void* instance, const NameData* name, ValueData* out) {
    return give(at(instance).get(to_utf8(name)), out);
  };
  info.list_properties = [](void* instance, uint32_t* count) {
    const std::vector<Property>& list = at(instance).properties();
    *count = static_cast<uint32_t>(list.size());
    return list.data();
  };
  info.free_properties = [](void*, const Property*, uint32_t) {};  // The node owns them.
  info.can_revert = [](void* instance, const NameData* name) -> Flag {
    return at(instance).initial(to_utf8(name)).has_value();
  };
  info.get_revert = [](void* instance, const NameData* name, ValueData* out) {
    return give(at(instance).initial(to_utf8(name)), out);
  };
  info.create = create;
  info.free = [](void*, void* instance) { delete &at(instance); };
  info.get_virtual = find_virtual;
  engine.register_class(engine.library, shared->class_name.get(), shared->parent_name.get(), &info);

  Name name("reset_motion");
  MethodInfo method{};
  method.name = name.get();
  method.call = [](void*, void* instance, const ValueData* const*, int64_t, ValueData*,
                   CallError*) { at(instance).reset_motion(); };
  method.call_plain = [](void*, void* instance, const void* const*, void*) {
    at(instance).reset_motion();
  };
  method.flags = kNormalMethod;
  engine.register_method(engine.library, shared->class_name.get(), &method);
}

void Character::unregister_class() {
  engine.unregister_class(engine.library, shared->class_name.get());
  shared.reset();
}

}  // namespace panache::godot

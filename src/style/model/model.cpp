#include "style/model/model.h"

#include <algorithm>

#include "base/file.h"
#include "base/text.h"
#include "pose/features.h"
#include "recipes/recipe.h"
#include "rig/humanoid.h"
#include "style/model/predictor_network.h"

namespace panache {

namespace {

constexpr const char* kFormatVersion = "1";
constexpr std::string_view kScale = ".scale";  // Of an int8 layer.

bool same_in_any_case(std::string_view one, std::string_view other) {
  return std::equal(one.begin(), one.end(), other.begin(), other.end(),
                    [](char a, char b) { return lower_case(a) == lower_case(b); });
}
// Whether `word` is one of `words`, which spaces separate, ignoring the case of A to Z.
bool has_word(std::string_view words, std::string_view word) {
  while (!words.empty()) {
    const size_t end = std::min(words.find(' '), words.size());
    if (end > 0 && same_in_any_case(words.substr(0, end), word)) return true;
    words.remove_prefix(std::min(end + 1, words.size()));
  }
  return false;
}

// "54 styles: moods, ages and bodies", or without the groups if there are none.
std::string list_groups(const std::vector<StyleInfo>& styles) {
  std::vector<std::string> groups;
  for (const StyleInfo& style : styles) {
    const bool known = std::find(groups.begin(), groups.end(), style.group) != groups.end();
    if (!known && !style.group.empty()) groups.push_back(style.group);
  }
  const std::string count = std::to_string(styles.size()) + " styles";
  return groups.empty() ? count : count + ": " + one_of(groups, " and ");
}

// Whether a tensor is a style's gesture, see Model::read_gestures().
bool is_gesture(std::string_view key) { return key.find("gesture.") != key.npos; }

// Looks up a metadata entry that every model has.
Result<std::string> require(const TensorFile& file, const std::string& key,
                            const std::string& name) {
  const auto found = file.metadata.find(key);
  if (found == file.metadata.end()) {
    return Error{name + ": metadata '" + key + "' is missing; expected a model written by panache"};
  }
  return found->second;
}

}  // namespace

Result<std::shared_ptr<const Model>> Model::load(const std::string& path) {
  Result<std::string> bytes = read_file(path);
  if (!bytes) return bytes.error();
  return parse(*bytes, path);
}

Result<std::shared_ptr<const Model>> Model::parse(std::string_view bytes, const std::string& name) {
  Result<TensorFile> file = parse_safetensors(bytes, name);
  if (!file) return file.error();
  return create(*file, name);
}

Result<std::shared_ptr<const Model>> Model::create(const TensorFile& file,
                                                   const std::string& name) {
  auto model = std::make_shared<Model>();
  if (Result<void> read = model->read_metadata(file, name); !read) return read.error();
  if (Result<void> read = model->read_numbers(file, name); !read) return read.error();
  for (const auto& [key, tensor] : file.tensors) {
    // Scales of int8 weights do not count as parameters.
    const bool unit = key.ends_with(kScale) &&
                      file.tensors.contains(key.substr(0, key.size() - kScale.size()) + ".weight");
    if (!unit && !is_gesture(key)) model->parameter_count_ += tensor.values.size();
  }
  return std::shared_ptr<const Model>(std::move(model));
}

Result<void> Model::read_metadata(const TensorFile& file, const std::string& name) {
  const auto format = file.metadata.find("format");
  if (format != file.metadata.end() && format->second == "panache-style") {
    return Error{name + ": is a style file, not a model", ErrorKind::is_style_file};
  }
  if (format == file.metadata.end() || format->second != "panache") {
    return Error{name +
                 ": is a safetensors file, but not a panache model; expected metadata "
                 "'format' to be 'panache'"};
  }
  Result<std::string> version = require(file, "format_version", name);
  if (!version) return version.error();
  if (*version != kFormatVersion) {
    return Error{name + ": is a model of format version " + *version +
                 "; this program reads version " + kFormatVersion +
                 "; train it again or use the program it came with"};
  }
  Result<std::string> recipe = require(file, "recipe", name);
  if (!recipe) return recipe.error();
  recipe_ = find_recipe(*recipe);
  if (!recipe_) {
    return Error{name + ": has recipe '" + *recipe + "'; expected " + recipe_names()};
  }
  Result<std::string> joints = require(file, "joints", name);
  if (!joints) return joints.error();
  if (*joints != canonical_joint_list()) {
    return Error{name + ": was trained on other joints than this program's 21; train it again"};
  }
  Result<std::string> window = require(file, "window", name);
  if (!window) return window.error();
  if (*window != window_description()) {
    return Error{name + ": sees a window of " + *window + "; expected " + window_description()};
  }
  Result<std::string> names = require(file, "styles", name);
  if (!names) return names.error();
  Result<std::string> descriptions = require(file, "style_descriptions", name);
  if (!descriptions) return descriptions.error();
  const auto origins = file.metadata.find("style_origins");
  const std::vector<std::string> texts = split_lines(*descriptions);
  const std::vector<std::string> sources =
      origins == file.metadata.end() ? std::vector<std::string>() : split_lines(origins->second);
  for (const std::string& style : split_lines(*names)) {
    const size_t i = styles_.size();
    styles_.push_back(
        {style, i < texts.size() ? texts[i] : "", i < sources.size() ? sources[i] : "", false});
  }
  const struct {
    const char* key;
    std::string StyleInfo::*entry;
  } lists[] = {{"style_groups", &StyleInfo::group},
               {"style_sources", &StyleInfo::source},
               {"style_licences", &StyleInfo::licence},
               {"style_thumbnails", &StyleInfo::thumbnail},
               {"style_sides", &StyleInfo::side},
               {"style_words", &StyleInfo::words},
               {"style_gesture_rates", &StyleInfo::gesture_rate}};
  for (const auto& [key, entry] : lists) {
    const auto found = file.metadata.find(key);
    if (found == file.metadata.end()) continue;
    const std::vector<std::string> lines = split_lines(found->second);
    if (lines.size() != styles_.size()) {
      return Error{name + ": metadata '" + key + "' has " + std::to_string(lines.size()) +
                   " lines; expected " + std::to_string(styles_.size()) + ", one per style"};
    }
    for (size_t i = 0; i < lines.size(); ++i) styles_[i].*entry = lines[i];
  }
  for (const StyleInfo& style : styles_) {
    if (Result<void> good = check_side_phrase(style.side); !good) {
      return Error{name + ": metadata 'style_sides': style '" + style.name +
                   "': " + good.error().message};
    }
    const Result<float> rate = read_gesture_rate(style.gesture_rate);
    if (!rate) {
      return Error{name + ": metadata 'style_gesture_rates': style '" + style.name +
                   "': " + rate.error().message};
    }
    gesture_rates_.push_back(*rate);
  }
  // A model without styles can be used to learn some.
  if (styles_.empty() && !recipe_->learns_styles) return Error{name + ": has no styles"};
  if (styles_.size() > kMaxStyles) {
    return Error{name + ": has " + std::to_string(styles_.size()) + " styles; expected at most " +
                 std::to_string(kMaxStyles)};
  }
  metadata_ = file.metadata;
  return {};
}

Result<int> Model::find_style(std::string_view style) const {
  std::vector<std::string> names;
  for (size_t i = 0; i < styles_.size(); ++i) {
    if (styles_[i].name == style) return static_cast<int>(i);
    names.push_back(styles_[i].name);
  }
  if (names.empty()) {
    return Error{"unknown style '" + std::string(style) + "'; the model has no styles yet",
                 ErrorKind::no_styles};
  }
  const std::vector<std::string> nearest = nearest_names(style, names);
  const std::string unknown = "unknown style '" + std::string(style) + "'; ";
  constexpr size_t kFew = 12;
  if (nearest.empty() && names.size() <= kFew) return Error{unknown + "expected " + one_of(names)};
  if (nearest.empty()) {
    return Error{unknown + "the model has " + list_groups(styles_), ErrorKind::unknown_style};
  }
  return Error{unknown + "the nearest " + is_or_are(nearest), ErrorKind::unknown_style};
}

Result<int> Model::find_style_by_any_name(std::string_view style) const {
  Result<int> exact = find_style(style);
  if (exact) return exact;
  const auto alike = [&](const StyleInfo& other) { return same_in_any_case(style, other.name); };
  const auto means = [&](const StyleInfo& other) { return has_word(other.words, style); };
  const bool is_name = std::count_if(styles_.begin(), styles_.end(), alike) == 1;
  const auto found = is_name ? std::find_if(styles_.begin(), styles_.end(), alike)
                             : std::find_if(styles_.begin(), styles_.end(), means);
  if (found == styles_.end()) return exact;
  return static_cast<int>(found - styles_.begin());
}

std::string canonical_joint_list() {
  std::string list;
  for (int j = 0; j < kHumanJoints; ++j) {
    if (j) list += ' ';
    list += human_joint_name(j);
  }
  return list;
}

std::string window_description() {
  static_assert(kWindowPoses == 6 && kWindowSpacing == 0.05);
  return "6 poses 0.05 s apart";
}

// Without streams, which would add all locales of the library to the page's module.
std::vector<std::string> split_lines(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const size_t end = std::min(text.find('\n'), text.size());
    lines.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

namespace {

// Calls visit(word) for each word between spaces.
template <class Visit>
void for_each_word(std::string_view text, Visit&& visit) {
  while (!text.empty()) {
    const size_t end = std::min(text.find(' '), text.size());
    visit(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

}  // namespace

Result<void> check_side_phrase(std::string_view phrase) {
  int sides = 0;
  for_each_word(phrase, [&](std::string_view word) { sides += word == "left" || word == "right"; });
  if (phrase.empty() || sides == 1) return {};
  return Error{"'" + std::string(phrase) +
               "'; expected a phrase with the word left or right in it once, such as 'left leg'"};
}

Result<void> check_has_sides(const Model& model) {
  if (model.recipe().style_heads) return {};
  return Error{std::string("the styles of a model of recipe ") + model.recipe().name +
               " have no sides, because they share their networks; expected a model in which each "
               "style has a head of its own"};
}

Result<float> find_side(const Model& model, int style, std::string_view word) {
  if (Result<void> good = check_has_sides(model); !good) return good.error();
  if (word == "captured") return 1.0f;
  if (word == "mirrored") return -1.0f;
  const StyleInfo& info = model.styles()[static_cast<size_t>(style)];
  const bool is_side = word == "left" || word == "right";
  if (is_side && !info.side.empty()) {
    bool same = false;
    for_each_word(info.side, [&](std::string_view other) { same = same || other == word; });
    return same ? 1.0f : -1.0f;
  }
  const std::string rest = "captured, mirrored or a number from -1 to 1";
  if (is_side) {
    return Error{"the model does not say which side style '" + info.name +
                 "' was captured on, so '" + std::string(word) + "' is unknown; expected " + rest};
  }
  return Error{"unknown side '" + std::string(word) + "' of style '" + info.name + "'; expected " +
               (info.side.empty() ? "" : "left, right, ") + rest};
}

}  // namespace panache

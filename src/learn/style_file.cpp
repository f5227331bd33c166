#include "learn/style_file.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <map>
#include <string_view>
#include <vector>

#include "base/bytes.h"
#include "base/text.h"
#include "clip/text_cursor.h"
#include "recipes/recipe.h"
#include "style/model/model.h"

namespace panache {
namespace {

constexpr const char* kStyleFormat = "panache-style";
constexpr const char* kStyleVersion = "1";
constexpr size_t kMaxNameBytes = 60;

// Names of a style's tensors in a style file.
constexpr std::array kBuiltInTensors = {
    "pose.reduce.weight", "pose.reduce.bias",    "pose.reduce.scale",  "pose.head.weight",
    "pose.head.bias",     "pose.head.scale",     "timing.head.weight", "timing.head.bias",
    "timing.head.scale",  "contact.head.weight", "contact.head.bias",  "contact.head.scale"};
constexpr std::array kLearntTensors = {"head.weight", "head.bias",   "head.scale",
                                       "mean",        "gate.weight", "gate.bias",
                                       "gate.scale",  "gate.worth",  "gate.rest"};

// Text of a style: metadata of its file, and an entry of a list in a model's metadata.
struct StyleText {
  const char *key, *list;
  std::string StyleInfo::*entry;
};
constexpr StyleText kTexts[] = {{"style", "styles", &StyleInfo::name},
                                {"description", "style_descriptions", &StyleInfo::description},
                                {"origin", "style_origins", &StyleInfo::origin},
                                {"group", "style_groups", &StyleInfo::group},
                                {"source", "style_sources", &StyleInfo::source},
                                {"style_licence", "style_licences", &StyleInfo::licence},
                                {"thumbnail", "style_thumbnails", &StyleInfo::thumbnail},
                                {"side", "style_sides", &StyleInfo::side},
                                {"words", "style_words", &StyleInfo::words},
                                {"gesture_rate", "style_gesture_rates", &StyleInfo::gesture_rate}};

using Tensors = std::map<std::string, Tensor>;

// A style and its tensors, named as in a style file.
struct Style {
  StyleInfo info;
  Tensors tensors;
};

// A model file without its styles, and the styles in order.
struct Parts {
  TensorFile rest;
  std::vector<Style> styles;
};

// The name in a model of a style file's tensor `key`, if `index` styles of its kind come before
// this one.
std::string key_in_model(const std::string& key, bool learnt, size_t index) {
  if (learnt) return "learnt." + std::to_string(index) + "." + key;
  // The contact network has a head for no style before those of the styles.
  const size_t head = index + (key.starts_with("contact.") ? 1 : 0);
  const size_t dot = key.rfind('.');
  return key.substr(0, dot + 1) + std::to_string(head) + key.substr(dot);
}

template <class Visit>
void for_each_tensor(bool learnt, Visit&& visit) {
  if (learnt) {
    for (const char* key : kLearntTensors) visit(key);
  } else {
    for (const char* key : kBuiltInTensors) visit(key);
  }
  for (size_t k = 0; k < kMaxGestures; ++k) visit(gesture_key(k));
}

// `parsed` is the same model, parsed.
Parts take_apart(const TensorFile& model, const Model& parsed) {
  Parts parts{model, {}};
  size_t built_in = 0, learnt = 0;
  for (const StyleInfo& info : parsed.styles()) {
    Style style{info, {}};
    const size_t index = info.learnt ? learnt++ : built_in++;
    for_each_tensor(info.learnt, [&](const std::string& key) {
      auto found = parts.rest.tensors.extract(key_in_model(key, info.learnt, index));
      if (found) style.tensors[key] = std::move(found.mapped());
    });
    parts.styles.push_back(std::move(style));
  }
  return parts;
}

// Writes the lists of styles in a model's metadata.
void write_lists(const std::vector<Style>& styles, std::map<std::string, std::string>& metadata) {
  for (const auto& [key, list, entry] : kTexts) {
    std::string lines;
    // Lists without entries are omitted, except for the first two.
    bool any = entry == &StyleInfo::name || entry == &StyleInfo::description;
    for (const Style& style : styles) {
      lines += style.info.*entry + "\n";
      any = any || !(style.info.*entry).empty();
    }
    metadata.erase(list);
    if (any) metadata[list] = lines;
  }
}

TensorFile put_together(Parts parts) {
  size_t built_in = 0, learnt = 0;
  for (Style& style : parts.styles) {
    const size_t index = style.info.learnt ? learnt++ : built_in++;
    for (auto& [key, tensor] : style.tensors) {
      parts.rest.tensors[key_in_model(key, style.info.learnt, index)] = std::move(tensor);
    }
  }
  write_lists(parts.styles, parts.rest.metadata);
  return std::move(parts.rest);
}

Result<void> check_has_heads(const Model& model, const std::string& name) {
  if (model.recipe().style_heads) return {};
  return Error{name + ": is of recipe " + model.recipe().name +
               ", whose styles are inputs of all its layers; expected a model of recipe " +
               learning_recipe_names() + ", where each has a head of its own"};
}

// `text` as one line of UTF-8; invalid characters are replaced.
std::string in_one_line(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  if (is_one_line(text)) return text;
  for (char& c : text) {
    if (static_cast<unsigned char>(c) >= 0x80) c = '?';
  }
  return text;
}

std::string metadata_of(const TensorFile& file, const std::string& key) {
  const auto found = file.metadata.find(key);
  return found == file.metadata.end() ? "" : found->second;
}

// The end of the styles of this kind.
auto end_of_kind(std::vector<Style>& styles, bool learnt) {
  if (learnt) return styles.end();
  return std::find_if(styles.begin(), styles.end(),
                      [](const Style& style) { return style.info.learnt; });
}

// A model without its styles, and the index of the style in question.
struct Opened {
  Parts parts;
  size_t style;
};
Result<Opened> open_at(const TensorFile& model, const std::string& style, const std::string& name) {
  Result<std::shared_ptr<const Model>> parsed = Model::create(model, name);
  if (!parsed) return parsed.error();
  if (auto heads = check_has_heads(**parsed, name); !heads) return heads.error();
  Result<int> index = (*parsed)->find_style(style);
  if (!index) return index.error();
  return Opened{take_apart(model, **parsed), size_t(*index)};
}

}  // namespace

std::string gesture_key(size_t gesture) { return "gesture." + std::to_string(gesture); }

std::string trunk_fingerprint(const TensorFile& model) {
  std::vector<float> values;
  const auto add = [&](const std::string& key) {
    const auto found = model.tensors.find(key);
    if (found == model.tensors.end()) return false;
    values.insert(values.end(), found->second.values.begin(), found->second.values.end());
    return true;
  };
  for (const char* key : {"input.mean", "input.scale", "output.scale"}) add(key);
  for (int layer = 0; add("pose.trunk." + std::to_string(layer) + ".bias"); ++layer) {
  }
  const uint64_t hash = hash_of(bytes_of(values));
  std::string text;
  for (int digit = 15; digit >= 0; --digit) text += "0123456789abcdef"[hash >> (4 * digit) & 15];
  return text;
}

bool is_one_line(const std::string& text) {
  const auto is_space = [](char c) { return c == '\t' || c == '\n' || c == '\r'; };
  if (std::ranges::any_of(text, is_space)) return false;
  // Everything else that a line of UTF-8 cannot contain is replaced there.
  return xml_escaped(text).find("\xef\xbf\xbd") == std::string::npos;
}

Result<void> check_style_name(const std::string& name) {
  const std::string where = "style name " + quoted(name) + ": ";
  if (name.empty()) return Error{where + "is empty"};
  if (name.size() > kMaxNameBytes) {
    return Error{where + "has " + std::to_string(name.size()) + " bytes; expected at most " +
                 std::to_string(kMaxNameBytes)};
  }
  if (!is_one_line(name)) return Error{where + "is not one line of UTF-8 text"};
  for (const char c : {'=', ','}) {
    if (name.find(c) == std::string::npos) continue;
    return Error{where + "holds a '" + c + "', which separates names from strengths"};
  }
  if (name.starts_with(' ') || name.ends_with(' ')) {
    return Error{where + "begins or ends with a space"};
  }
  if (name.starts_with('-')) return Error{where + "must not start with '-'"};
  if (lower_case(name) == "neutral") {
    return Error{where + "is the name of motion without a style"};
  }
  if (name == "seconds") {
    return Error{where + "is the name of the time column in tables of strengths"};
  }
  return {};
}

bool is_style_file(const TensorFile& file) { return metadata_of(file, "format") == kStyleFormat; }

Result<StyleInfo> read_style_info(const TensorFile& file, const std::string& name) {
  if (metadata_of(file, "format") == "panache") {
    return Error{name + ": is a model; expected a style file", ErrorKind::is_model};
  }
  if (!is_style_file(file)) {
    return Error{name + ": is a safetensors file, but not a style; expected metadata 'format' to " +
                 "be '" + kStyleFormat + "'"};
  }
  if (const std::string version = metadata_of(file, "format_version"); version != kStyleVersion) {
    return Error{name + ": is a style file of format version " + quoted(version) +
                 "; this program reads version " + kStyleVersion};
  }
  StyleInfo info;
  info.learnt = file.tensors.contains("head.weight");
  for (const auto& [key, list, entry] : kTexts) info.*entry = metadata_of(file, key);
  if (auto fit = check_style_name(info.name); !fit) return located(name, fit.error());
  for (const char* key : {"description", "origin", "group", "source", "style_licence", "thumbnail",
                          "side", "words", "trunk", "data", "licence"}) {
    if (is_one_line(metadata_of(file, key))) continue;
    return Error{name + ": metadata '" + key + "' is not one line of UTF-8 text"};
  }
  if (auto side = check_side_phrase(info.side); !side) {
    return Error{name + ": metadata 'side': " + side.error().message};
  }
  if (auto rate = read_gesture_rate(info.gesture_rate); !rate) {
    return Error{name + ": metadata 'gesture_rate': " + rate.error().message};
  }
  size_t known = 0;
  for_each_tensor(info.learnt,
                  [&](const std::string& key) { known += file.tensors.contains(key); });
  if (known == 0 || known != file.tensors.size()) {
    return Error{name + ": has " + std::to_string(file.tensors.size()) + " tensors, of which " +
                 std::to_string(known) + " are those of a style; expected no others"};
  }
  for (const auto& [key, tensor] : file.tensors) {
    const auto is_finite = [](float value) { return std::isfinite(value); };
    if (std::ranges::all_of(tensor.values, is_finite)) continue;
    return Error{name + ": tensor '" + key + "' holds a number that is not finite"};
  }
  return info;
}

TensorFile make_style_file(const TensorFile& model, const StyleInfo& info,
                           std::map<std::string, Tensor> tensors) {
  TensorFile file;
  file.metadata = {{"format", kStyleFormat},
                   {"format_version", kStyleVersion},
                   {"trunk", trunk_fingerprint(model)}};
  for (const auto& [key, list, entry] : kTexts) {
    const bool always = entry == &StyleInfo::description || entry == &StyleInfo::origin;
    if (always || !(info.*entry).empty()) file.metadata[key] = in_one_line(info.*entry);
  }
  file.metadata["style"] = info.name;
  for (const char* key : {"data", "licence"}) {
    if (model.metadata.contains(key)) file.metadata[key] = model.metadata.at(key);
  }
  file.tensors = std::move(tensors);
  return file;
}

void set_source(const std::string& source, const std::string& licence, TensorFile& style) {
  if (!source.empty()) style.metadata["source"] = in_one_line(source);
  if (!licence.empty()) style.metadata["style_licence"] = in_one_line(licence);
}

Result<TensorFile> extract_style(const TensorFile& model, const std::string& style,
                                 const std::string& name) {
  Result<Opened> opened = open_at(model, style, name);
  if (!opened) return opened.error();
  Style& found = opened->parts.styles[opened->style];
  return make_style_file(model, found.info, std::move(found.tensors));
}

Result<TensorFile> add_style(const TensorFile& model, const std::string& name,
                             const TensorFile& style, const std::string& style_name, bool replace) {
  Result<StyleInfo> info = read_style_info(style, style_name);
  if (!info) return info.error();
  Result<std::shared_ptr<const Model>> parsed = Model::create(model, name);
  if (!parsed) return parsed.error();
  if (auto heads = check_has_heads(**parsed, name); !heads) return heads.error();
  const std::string trunk = trunk_fingerprint(model), made_for = metadata_of(style, "trunk");
  if (trunk != made_for) {
    return Error{style_name + ": is a style of another model (its trunk is " + quoted(made_for) +
                     ", that of " + name + " is " + quoted(trunk) +
                     "); use it with the model that it was made with or the int8 version of that "
                     "model, or learn it again with this one",
                 ErrorKind::style_of_another};
  }
  Parts parts = take_apart(model, **parsed);
  std::vector<Style>& styles = parts.styles;
  Style added{*info, style.tensors};
  // A trained style's picture is drawn on extraction; without it, adding back restores the model.
  if (!info->learnt) added.info.thumbnail.clear();
  const auto taken = std::find_if(styles.begin(), styles.end(), [&](const Style& other) {
    return other.info.name == info->name;
  });
  if (taken != styles.end() && !replace) {
    return Error{name + ": has a style '" + info->name +
                     "' already; replace it or give one of the two another name",
                 ErrorKind::style_exists};
  }
  if (taken != styles.end() && taken->info.learnt == info->learnt) {
    *taken = std::move(added);
  } else {
    if (taken != styles.end()) styles.erase(taken);
    styles.insert(end_of_kind(styles, info->learnt), std::move(added));
  }
  TensorFile merged = put_together(std::move(parts));
  // Model::create() knows best what a model can hold and evaluate.
  if (auto read = Model::create(merged, name + " with " + style_name); !read) return read.error();
  return merged;
}

Result<TensorFile> set_gestures(const TensorFile& model, const std::string& style,
                                std::span<const Gesture> gestures, float rate,
                                const std::string& name) {
  assert(gestures.size() <= kMaxGestures);
  Result<Opened> opened = open_at(model, style, name);
  if (!opened) return opened.error();
  Style& found = opened->parts.styles[opened->style];
  Tensors& tensors = found.tensors;
  for (size_t k = 0; k < kMaxGestures; ++k) tensors.erase(gesture_key(k));
  for (size_t k = 0; k < gestures.size(); ++k) tensors[gesture_key(k)] = gestures[k].tensor();
  found.info.gesture_rate = gestures.empty() ? "" : with_decimals(double{rate}, 3);
  return put_together(std::move(opened->parts));
}

Result<TensorFile> remove_style(const TensorFile& model, const std::string& style,
                                const std::string& name) {
  Result<Opened> opened = open_at(model, style, name);
  if (!opened) return opened.error();
  Parts& parts = opened->parts;
  if (parts.styles.size() == 1) {
    return Error{name + ": has no style but '" + style + "'; a model keeps at least one"};
  }
  parts.styles.erase(parts.styles.begin() + opened->style);
  return put_together(std::move(parts));
}

Result<TensorFile> rename_style(const TensorFile& model, const std::string& from,
                                const std::string& to, const std::string& name) {
  Result<std::shared_ptr<const Model>> parsed = Model::create(model, name);
  if (!parsed) return parsed.error();
  Result<int> index = (*parsed)->find_style(from);
  if (!index) return index.error();
  if (auto fit = check_style_name(to); !fit) return fit.error();
  if ((*parsed)->find_style(to)) return Error{name + ": has a style '" + to + "' already"};
  std::vector<Style> styles;
  for (const StyleInfo& info : (*parsed)->styles()) styles.push_back({info, {}});
  styles[*index].info.name = to;
  TensorFile renamed = model;
  write_lists(styles, renamed.metadata);
  return renamed;
}

}  // namespace panache

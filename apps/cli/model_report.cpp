#include "model_report.h"

#include <algorithm>
#include <filesystem>
#include <span>

#include "base/file.h"
#include "learn/style_file.h"

namespace panache::cli {
namespace {

// A metadata entry; empty if missing.
std::string entry(const std::map<std::string, std::string>& metadata, const std::string& key) {
  const auto found = metadata.find(key);
  return found == metadata.end() ? "" : found->second;
}
std::string entry(const Model& model, const std::string& key) {
  return entry(model.metadata(), key);
}

std::string stated(const std::string& text) { return text.empty() ? "not stated" : text; }

// The sources of the file and their licences.
std::string describe_data(const std::map<std::string, std::string>& metadata) {
  const std::string data = entry(metadata, "data"), licence = entry(metadata, "licence");
  return "  trained on   " + stated(data) + "\n" + "  data licence " + stated(licence) + "\n";
}

// "gestures, 0.2 a second: nods, 1.2 s; ducks, 0.8 s"; empty if there are none.
std::string list_gestures(std::span<const std::string> gestures, const std::string& rate) {
  std::string text;
  for (const std::string& name : gestures) text += (text.empty() ? ": " : "; ") + name;
  if (text.empty()) return "";
  return "gestures" + (rate.empty() ? "" : ", " + rate + " a second") + text;
}

// One line for the style, with the description in column `width`; below it the style's sources,
// side and gestures.
std::string describe(const StyleInfo& style, std::span<const std::string> gestures, size_t width) {
  const std::string from = style.origin.empty() ? "" : " from " + style.origin;
  const std::string origin = style.learnt ? "learnt" + from : "";
  std::string text;
  std::string name = style.name;
  const std::string side = style.side.empty() ? "" : "side: " + style.side;
  for (const std::string& given :
       {style.description, origin, side, list_gestures(gestures, style.gesture_rate)}) {
    if (given.empty()) continue;
    text += "  " + padded(name, width) + given + "\n";
    name.clear();
  }
  return text.empty() ? "  " + name + "\n" : text;
}

std::vector<std::string> gestures_of(const Model& model, ptrdiff_t style) {
  std::vector<std::string> names;
  for (const Gesture& gesture : model.gestures(static_cast<int>(style))) {
    names.push_back(gesture.name());
  }
  return names;
}

struct Group {
  std::string title;  // Empty if the model has no groups.
  std::vector<const StyleInfo*> styles;
};

// The styles by group; groups are ordered by their first style.
std::vector<Group> group_styles(const std::vector<StyleInfo>& styles) {
  const auto has_group = [](const StyleInfo& style) { return !style.group.empty(); };
  const bool any = std::ranges::any_of(styles, has_group);
  std::vector<Group> groups;
  for (const StyleInfo& style : styles) {
    std::string title = style.group;
    if (any && title.empty()) title = style.learnt ? "learnt" : "others";
    auto found = std::ranges::find(groups, title, &Group::title);
    if (found == groups.end()) found = groups.insert(found, {title, {}});
    found->styles.push_back(&style);
  }
  return groups;
}

// Names separated by commas, in lines of at most 80 letters with an indent of `indent` spaces.
std::string list_names(const Group& group, size_t indent) {
  constexpr size_t kWidth = 80;
  std::string text;
  size_t column = indent;
  for (const StyleInfo* style : group.styles) {
    const bool last = style == group.styles.back();
    const std::string word = style->name + (last ? "" : ",");
    if (!text.empty() && column + 1 + word.size() > kWidth) {
      text += "\n" + std::string(indent, ' ');
      column = indent;
    } else if (!text.empty()) {
      text += " ";
      ++column;
    }
    text += word;
    column += word.size();
  }
  return text + "\n";
}

// All except the styles.
std::string describe_head(const LoadedModel& loaded) {
  const Model& model = *loaded.model;
  std::string text = loaded.path + "\n";
  text += "  recipe       " + entry(model, "recipe") + "\n";
  text += "  size         " + fixed(static_cast<double>(loaded.bytes) / 1000, 0) + " KB, " +
          std::to_string(model.parameter_count()) + " numbers\n";
  text += describe_data(model.metadata()) + "\n";
  if (model.styles().empty()) return text + "no styles yet: panache learn adds them\n";
  return text + plural(model.styles().size(), "style") + ":\n";
}

// The source of a style's motion and its licence: the style's own, else those of the model's
// training data; "not stated" if both are missing.
std::string source_of(const LoadedStyle& loaded) {
  const StyleInfo& info = loaded.info;
  if (!info.source.empty()) return info.source;
  if (info.learnt && !info.origin.empty()) return info.origin;
  return stated(entry(loaded.file.metadata, "data"));
}

std::string licence_of(const LoadedStyle& loaded) {
  if (!loaded.info.licence.empty()) return loaded.info.licence;
  // A style learnt from a user's motion is the user's; the model's data licence does not apply.
  return stated(loaded.info.learnt ? "" : entry(loaded.file.metadata, "licence"));
}

}  // namespace

Result<LoadedModel> load_model(const std::string& path) {
  Result<std::string> bytes = read_file(path);
  if (!bytes) return bytes.error();
  Result<std::shared_ptr<const Model>> model = Model::parse(*bytes, path);
  if (!model) return model.error();
  return LoadedModel{path, *model, bytes->size()};
}

Result<LoadedStyle> load_style(const std::string& path) {
  Result<std::string> bytes = read_file(path);
  if (!bytes) return bytes.error();
  Result<TensorFile> file = parse_safetensors(*bytes, path);
  if (!file) return file.error();
  Result<StyleInfo> info = read_style_info(*file, path);
  if (!info) return info.error();
  std::vector<Gesture> gestures;
  for (size_t k = 0; file->tensors.contains(gesture_key(k)); ++k) {
    Result<Gesture> gesture = Gesture::read(file->tensors[gesture_key(k)], gesture_key(k), path);
    if (!gesture) return gesture.error();
    gestures.push_back(*std::move(gesture));
  }
  name_gestures(gestures);
  LoadedStyle style{path, *std::move(info), {}, *std::move(file), bytes->size()};
  for (const Gesture& gesture : gestures) style.gestures.push_back(gesture.name());
  return style;
}

std::string describe(const LoadedModel& loaded) {
  const std::vector<StyleInfo>& styles = loaded.model->styles();
  std::string text = describe_head(loaded);
  size_t width = 0;
  for (const StyleInfo& style : styles) width = std::max(width, style.name.size());
  for (const Group& group : group_styles(styles)) {
    if (!group.title.empty()) text += "\n" + group.title + ":\n";
    for (const StyleInfo* style : group.styles) {
      text += describe(*style, gestures_of(*loaded.model, style - styles.data()), width + 2);
    }
  }
  return text;
}

std::string summarize(const LoadedModel& loaded) {
  const std::vector<Group> groups = group_styles(loaded.model->styles());
  std::string text = describe_head(loaded);
  size_t width = 0;
  for (const Group& group : groups) width = std::max(width, group.title.size());
  const size_t indent = width == 0 ? 2 : width + 4;
  for (const Group& group : groups) {
    text += width == 0 ? "  " : "  " + padded(group.title, width + 2);
    text += list_names(group, indent);
  }
  return text;
}

Json to_json(const LoadedModel& loaded) {
  const Model& model = *loaded.model;
  Json styles = Json::array();
  for (const StyleInfo& style : model.styles()) {
    styles.push_back({{"name", style.name},
                      {"gestures", gestures_of(model, &style - model.styles().data())},
                      {"gesture_rate", style.gesture_rate},
                      {"description", style.description},
                      {"group", style.group},
                      {"side", style.side},
                      {"learnt", style.learnt},
                      {"origin", style.origin},
                      {"source", style.source},
                      {"licence", style.licence}});
  }
  return {{"model", loaded.path},
          {"recipe", entry(model, "recipe")},
          {"data", entry(model, "data")},
          {"licence", entry(model, "licence")},
          {"bytes", loaded.bytes},
          {"parameters", model.parameter_count()},
          {"styles", styles}};
}

std::string describe(const LoadedStyle& loaded) {
  std::string text = loaded.path + "\n";
  text += "  size         " + fixed(static_cast<double>(loaded.bytes) / 1000, 0) + " KB\n";
  text += "  trunk        " + entry(loaded.file.metadata, "trunk") + "\n";
  if (!loaded.info.group.empty()) text += "  group        " + loaded.info.group + "\n";
  if (!loaded.info.source.empty()) text += "  source       " + loaded.info.source + "\n";
  if (!loaded.info.licence.empty()) text += "  licence      " + loaded.info.licence + "\n";
  text += describe_data(loaded.file.metadata);
  return text + "\n1 style:\n" +
         describe(loaded.info, loaded.gestures, loaded.info.name.size() + 2);
}

Json to_json(const LoadedStyle& loaded) {
  return {{"style_file", loaded.path},
          {"name", loaded.info.name},
          {"description", loaded.info.description},
          {"group", loaded.info.group},
          {"side", loaded.info.side},
          {"gestures", loaded.gestures},
          {"gesture_rate", loaded.info.gesture_rate},
          {"learnt", loaded.info.learnt},
          {"origin", loaded.info.origin},
          {"source", loaded.info.source},
          {"style_licence", loaded.info.licence},
          {"thumbnail", loaded.info.thumbnail},
          {"trunk", entry(loaded.file.metadata, "trunk")},
          {"data", entry(loaded.file.metadata, "data")},
          {"licence", entry(loaded.file.metadata, "licence")},
          {"bytes", loaded.bytes}};
}

Result<StyleLibrary> read_library(const std::string& folder) {
  namespace fs = std::filesystem;
  std::error_code status;
  std::vector<std::string> paths;
  for (const auto& entry : fs::directory_iterator(folder, status)) {
    if (entry.path().extension() == ".safetensors") paths.push_back(entry.path().string());
  }
  if (status) return Error{folder + ": is no folder that can be read: " + status.message()};
  std::ranges::sort(paths);
  StyleLibrary library{folder, {}, {}};
  for (const std::string& path : paths) {
    Result<LoadedStyle> style = load_style(path);
    if (style) {
      library.styles.push_back(*std::move(style));
    } else if (style.error().kind != ErrorKind::is_model) {
      library.broken.push_back(style.error());
    }
  }
  return library;
}

std::string describe(const StyleLibrary& library) {
  std::string text = library.folder + "\n" + plural(library.styles.size(), "style") + ":\n";
  size_t width = 0;
  for (const LoadedStyle& style : library.styles) width = std::max(width, style.info.name.size());
  for (const LoadedStyle& style : library.styles) {
    const std::string file = std::filesystem::path(style.path).filename().string();
    text += "  " + padded(style.info.name, width + 2) + style.info.description + "\n";
    text += "  " + padded("", width + 2) + "source: " + source_of(style) +
            "; licence: " + licence_of(style) + "; " + file + "\n";
  }
  return text;
}

Json to_json(const StyleLibrary& library) {
  Json styles = Json::array();
  for (const LoadedStyle& style : library.styles) styles.push_back(to_json(style));
  return {{"library", library.folder}, {"styles", styles}};
}

TensorFile with_library(TensorFile model, const std::string& name, const StyleLibrary& library) {
  for (const LoadedStyle& style : library.styles) {
    Result<TensorFile> merged = add_style(model, name, style.file, style.path, true);
    if (merged) {
      model = *std::move(merged);
    } else {
      print_message("warning: " + merged.error().message);
    }
  }
  return model;
}

}  // namespace panache::cli

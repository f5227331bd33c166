#include "rig_options.h"

#include <string_view>
#include <vector>

#include "base/file.h"
#include "base/text.h"
#include "clip/text_cursor.h"
#include "messages.h"
#include "rig/humanoid.h"

namespace panache::cli {
namespace {

// From nanometres to kilometres.
constexpr double kSmallestUnit = 1e-9, kLargestUnit = 1e3;
constexpr const char* kExpectedMap =
    "expected JSON such as {\"leftHand\": \"Hand_L\", \"neck\": null}";

// "z" and "+Z" are equivalent; empty if `text` is not an axis.
std::string axis_name(std::string text) {
  for (char& c : text) {
    if (c >= 'x' && c <= 'z') c = static_cast<char>(c - 'x' + 'X');
  }
  if (text.size() == 1) text.insert(text.begin(), '+');
  const bool good =
      text.size() == 2 && (text[0] == '+' || text[0] == '-') && text[1] >= 'X' && text[1] <= 'Z';
  return good ? text : "";
}

Result<int> parse_human_joint(const std::string& joint, const std::string& name) {
  if (const std::optional<int> known = find_human_joint(joint)) return *known;
  std::vector<std::string> names;
  names.reserve(kHumanJoints);
  for (int j = 0; j < kHumanJoints; ++j) names.emplace_back(human_joint_name(j));
  const std::vector<std::string> nearest = nearest_names(joint, names, 1);
  return Error{name + ": unknown human joint " + panache::quoted(joint) +
               (nearest.empty() ? "" : "; the nearest " + is_or_are(nearest)) +
               " (panache info lists all " + std::to_string(kHumanJoints) + ")"};
}

Result<void> put(const std::string& human_joint, const Json& joint, const std::string& name,
                 std::map<int, std::string>& out) {
  Result<int> human = parse_human_joint(human_joint, name);
  if (!human) return human.error();
  if (!joint.is_null() && (!joint.is_string() || joint.get_ref<const std::string&>().empty())) {
    return Error{name + ": " + human_joint + ": expected the name of a joint or null, found " +
                 joint.dump(-1, ' ', false, Json::error_handler_t::replace).substr(0, 40)};
  }
  const auto [other, is_new] = out.emplace(*human, joint.is_null() ? "" : joint.get<std::string>());
  if (!is_new) return Error{name + ": " + human_joint + " is there twice"};
  return {};
}

// Reads the list that panache info --json prints; ignores its informative entries.
Result<void> put_list(const Json& list, const std::string& name, std::map<int, std::string>& out) {
  for (size_t i = 0; i < list.size(); ++i) {
    const Json& entry = list[i];
    if (!entry.is_object() || !entry.contains("humanoid") || !entry["humanoid"].is_string() ||
        !entry.contains("joint")) {
      return Error{name + ": mapping.joints[" + std::to_string(i) +
                   "]: expected an object with 'humanoid' and 'joint', as panache info --json "
                   "prints them"};
    }
    auto good = put(entry["humanoid"].get<std::string>(), entry["joint"], name, out);
    if (!good) return good;
  }
  return {};
}

std::string position_in(const std::string& text, size_t byte) {
  const std::string_view before = std::string_view(text).substr(0, byte > 0 ? byte - 1 : 0);
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const size_t line_begin = before.rfind('\n') + 1;  // npos + 1 is 0.
  return std::to_string(line) + ":" + std::to_string(before.size() - line_begin + 1);
}

}  // namespace

void add_rig_options(CLI::App& verb, RigFlags& flags) {
  add_option(verb, "--scale METRES", flags.scale,
             "Metres per unit of the file (0.01: centimetres);\ndefault: inferred from the legs");
  add_option(verb, "--up AXIS", flags.up, "Up axis: x, y, z, -x ...; default: inferred");
  add_option(verb, "--map FILE", flags.map,
             "JSON map of joints, as in\n{\"leftHand\": \"Hand_L\", "
             "\"neck\": null}, or an edited\n'panache info --json'; others are found");
  add_option(verb, "--skeleton NAME", flags.skeleton,
             "Figure to take, if a file has several, by its topmost\njoint; default: those that "
             "the motion moves");
}

Result<void> check_rig_flags(const RigFlags& flags) {
  if (!flags.up.empty() && axis_name(flags.up).empty()) {
    return Error{"--up: expected an axis (x, y, z, -x, -y or -z), found " +
                 panache::quoted(flags.up)};
  }
  return flags.scale ? check_range("--scale", *flags.scale, kSmallestUnit, kLargestUnit)
                     : Result<void>();
}

Result<RigOptions> read_rig_options(const RigFlags& flags) {
  RigOptions options;
  if (flags.scale) options.metres_per_unit = static_cast<float>(*flags.scale);
  if (!flags.up.empty()) options.up_axis = axis_name(flags.up);
  options.figure = flags.skeleton;
  if (flags.map.empty()) return options;
  Result<std::string> text = read_file(flags.map);
  if (!text) return text.error();
  Result<std::map<int, std::string>> joints = parse_joint_map(*text, flags.map);
  if (!joints) return joints.error();
  options.joints = *std::move(joints);
  return options;
}

Result<std::map<int, std::string>> parse_joint_map(const std::string& text,
                                                   const std::string& name) {
  Json map;
  try {
    map = Json::parse(text);
  } catch (const Json::parse_error& error) {
    return Error{name + ":" + position_in(text, error.byte) + ": " + kExpectedMap};
  } catch (const Json::out_of_range&) {
    return Error{name + ": " + kExpectedMap + ", found a number that is too large"};
  }
  std::map<int, std::string> joints;
  if (map.is_object() && map.contains("mapping")) {
    const Json& mapping = map["mapping"];
    if (!mapping.is_object() || !mapping.contains("joints") || !mapping["joints"].is_array()) {
      return Error{name + ": holds no mapping, because that file has no humanoid; " + kExpectedMap};
    }
    if (auto good = put_list(mapping["joints"], name, joints); !good) return good.error();
    return joints;
  }
  if (!map.is_object() || map.empty()) {
    return Error{name + ": " + kExpectedMap + ", found " +
                 (map.is_object() ? "nothing in it" : std::string("a JSON ") + map.type_name())};
  }
  for (const auto& [human_joint, joint] : map.items()) {
    if (auto good = put(human_joint, joint, name, joints); !good) return good.error();
  }
  return joints;
}

}  // namespace panache::cli

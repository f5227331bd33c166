#include "rig_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace panache::cli {
namespace {

// What the file's unit may be; empty where nothing comes close.
std::string likely_unit(double metres) {
  struct Unit {
    const char* name;
    double metres;
  };
  static constexpr std::array<Unit, 6> kUnits = {{{"metres", 1},
                                                  {"feet", 0.3048},
                                                  {"CMU units", 0.0564},
                                                  {"inches", 0.0254},
                                                  {"centimetres", 0.01},
                                                  {"millimetres", 0.001}}};
  // The scale is that of canonical legs, and people differ: 1.35 lies half-way between the
  // neighbours in this list that are nearest to each other.
  for (const Unit& unit : kUnits) {
    if (std::abs(std::log(metres / unit.metres)) < std::log(1.35)) return unit.name;
  }
  return "";
}

std::string percent(const JointMatch& match) {
  return match.joint.empty() ? "-" : fixed(100.0 * static_cast<double>(match.confidence), 0) + "%";
}

std::string table(const std::vector<JointMatch>& matches) {
  const std::string column = "joint of the file";
  size_t human = 0, own = column.size();
  for (const JointMatch& match : matches) {
    human = std::max(human, match.human_joint.size());
    own = std::max(own, match.joint.size());
  }
  std::string text = "  " + padded("humanoid", human + 2) + padded(column, own + 2) +
                     padded("sure", 6) + "how it was found\n";
  for (const JointMatch& match : matches) {
    text += "  " + padded(match.human_joint, human + 2) +
            padded(match.joint.empty() ? "-" : match.joint, own + 2) + padded(percent(match), 6) +
            match.reason + "\n";
  }
  return text;
}

}  // namespace

std::string describe_mapping(const Rig& rig, const RigOptions& given) {
  const auto scale = static_cast<double>(rig.scale());
  const std::string unit = likely_unit(scale);
  std::string text = "  unit    " + brief(scale, 3) + " m";
  if (given.metres_per_unit) {
    text += ", as given\n";
  } else {
    text += (unit.empty() ? "" : " (" + unit + ", most likely)") + ", inferred from the legs\n";
  }
  text += "  up      " + rig.up_axis() + (given.up_axis ? ", as given\n" : "\n");
  text += std::string("  start   ") +
          (rig.first_frame()
               ? "the first frame is a calibration pose, not motion: stylize leaves it unchanged"
               : "the first frame is motion") +
          "\n\n" + table(rig.matches());
  if (!rig.notes().empty()) text += "\nNotes:\n";
  for (const std::string& note : rig.notes()) text += "  " + note + "\n";
  return text;
}

Json mapping_json(const Rig& rig) {
  Json joints = Json::array();
  for (const JointMatch& match : rig.matches()) {
    joints.push_back(
        {{"humanoid", match.human_joint},
         {"joint", match.joint.empty() ? Json() : Json(match.joint)},
         {"confidence", std::round(100.0 * static_cast<double>(match.confidence)) / 100},
         {"reason", match.reason}});
  }
  const auto scale = static_cast<double>(rig.scale());
  const std::string unit = likely_unit(scale);
  return {{"metres_per_unit", scale}, {"likely_unit", unit.empty() ? Json() : Json(unit)},
          {"up_axis", rig.up_axis()}, {"first_frame", rig.first_frame()},
          {"joints", joints},         {"notes", rig.notes()}};
}

}  // namespace panache::cli

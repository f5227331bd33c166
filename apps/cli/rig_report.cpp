#include "rig_report.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "rig/figures.h"

namespace panache::cli {
namespace {

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
  const auto usual = usual_unit(static_cast<double>(rig.scale()));
  std::string text = "  unit    " + brief(static_cast<double>(rig.unit()), 3) + " m";
  if (given.metres_per_unit) {
    text += ", as given\n";
  } else {
    text += (usual ? " (" + std::string(usual->name) + ", most likely)" : "") +
            ", inferred from the legs\n";
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
  const auto usual = usual_unit(static_cast<double>(rig.scale()));
  return {{"metres_per_unit", static_cast<double>(rig.unit())},
          {"likely_unit", usual ? Json(usual->name) : Json()},
          {"up_axis", rig.up_axis()},
          {"first_frame", rig.first_frame()},
          {"joints", joints},
          {"notes", rig.notes()}};
}

}  // namespace panache::cli

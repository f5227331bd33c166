#pragma once
// Rig settings given by the user instead of detected: --scale, --up, --map and --skeleton.

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "base/result.h"
#include "rig/rig.h"

namespace panache::cli {

struct RigFlags {
  std::optional<double> scale;  // Metres per file unit.
  std::string up;               // As typed, or empty.
  std::string map;              // A JSON file, or empty.
  std::string skeleton;         // A figure of several, or empty.
};

// Gives `verb` these options; `flags` must outlive it.
void add_rig_options(CLI::App& verb, RigFlags& flags);

// Checks the scale's range and the axis without reading any file.
Result<void> check_rig_flags(const RigFlags& flags);
// Reads the mapping file and returns the options for the rig. Call check_rig_flags() first.
Result<RigOptions> read_rig_options(const RigFlags& flags);

// The joints of a mapping: {"leftHand": "Hand_L", "neck": null}, or the output of panache info
// --json. Failure messages begin with `name`.
Result<std::map<int, std::string>> parse_joint_map(const std::string& text,
                                                   const std::string& name);

}  // namespace panache::cli

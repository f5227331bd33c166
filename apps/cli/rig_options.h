#pragma once
// What the user says of a rig instead of having it found: --scale, --up and --map.

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
};

// Gives `verb` the three options; `flags` must outlive it.
void add_rig_options(CLI::App& verb, RigFlags& flags);

// Checks what the command line says, without reading anything: the scale's range and the axis.
Result<void> check_rig_flags(const RigFlags& flags);
// The same as the rig wants it, the mapping file read. The flags have passed the check.
Result<RigOptions> read_rig_options(const RigFlags& flags);

// The joints of a mapping: {"leftHand": "Hand_L", "neck": null}, or what panache info --json
// prints. `name` stands in front of the message of a failure.
Result<std::map<int, std::string>> parse_joint_map(const std::string& text,
                                                   const std::string& name);

}  // namespace panache::cli

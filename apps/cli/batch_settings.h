#pragma once
// What a batch is made with: all that may change its results.

#include <string>

#include <CLI/CLI.hpp>

#include "messages.h"

namespace panache::cli {

// {"version", "verb", "model": {"file", "sha256"} or null, "options": {"--style": ["old=1"], ...},
// "files": {"--map": sha256, ...}}: the options given to `verb`, without those that choose files
// and messages. `model`: its file, or empty.
Json batch_settings(const CLI::App& verb, const std::string& model);

// Sixteen hexadecimal digits: the same for the same settings.
std::string id_of(const Json& settings);

}  // namespace panache::cli

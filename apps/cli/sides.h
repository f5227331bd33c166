#pragma once
// The sides of styles, from the command line (--side) and from messages.

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "base/result.h"
#include "strengths.h"
#include "style/model/model.h"

namespace panache::cli {

// `texts` must outlive the verb.
void add_side_option(CLI::App& verb, std::vector<std::string>& texts);

// A side as typed: a word of find_side(), or a number from -1 to 1. `style`: index in the model.
Result<float> read_side(const Model& model, int style, const std::string& text);

// Reads "limping=left" and the like: a side for each style of the model; empty if there are no
// texts.
Result<std::vector<float>> parse_sides(const std::vector<std::string>& texts, const Model& model);

// Fails if a side is given for a style that no wish puts on.
Result<void> check_sides_used(const std::vector<std::string>& texts,
                              const std::vector<StrengthWish>& wishes, const Model& model);

// The side of a style in a list by parse_sides().
float side_of(const std::vector<float>& sides, int style);
// A short form for names: "" as captured, " mirrored", " side 0.5".
std::string describe_side(float side);

}  // namespace panache::cli

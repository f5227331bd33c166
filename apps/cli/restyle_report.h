#pragma once
// What stylize did to a motion, told in a line or in JSON.

#include <string>

#include "messages.h"
#include "style/restyle_facts.h"

namespace panache::cli {

// "loop closed; feet held; 96% known motion".
std::string describe(const RestyleFacts& facts);
Json facts_json(const RestyleFacts& facts);

}  // namespace panache::cli

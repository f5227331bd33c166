#pragma once
// Names of motions that are not taken.

#include <map>
#include <string>

namespace panache {

// Names that are taken, each with the number of times that it was asked for.
using TakenNames = std::map<std::string, int>;
// `name`, or where it is taken the same with the next free " (2)", " (3)", ...; then taken too.
std::string unique_name(const std::string& name, TakenNames& taken);

}  // namespace panache

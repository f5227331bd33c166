#pragma once
// Names of motions that are not taken.

#include <map>
#include <string>

namespace panache {

// Names that are taken, each with the number of times that it was asked for.
using TakenNames = std::map<std::string, int>;
// `name`, or where it is taken the same with the next free " (2)", " (3)", ...; then taken too.
inline std::string unique_name(const std::string& name, TakenNames& taken) {
  int& asked = taken[name];  // Insertions move nothing in a map.
  std::string result = name;
  while (++asked > 1) {
    result = name + " (" + std::to_string(asked) + ")";
    if (taken.emplace(result, 1).second) break;
  }
  return result;
}

}  // namespace panache

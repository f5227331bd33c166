#pragma once
// Unique names for motions.

#include <map>
#include <string>

namespace panache {

// Taken names, each with the number of requests for it.
using TakenNames = std::map<std::string, int>;
// `name`, or if it is taken, the same with the next free " (2)", " (3)", ...; marks it as taken.
inline std::string unique_name(const std::string& name, TakenNames& taken) {
  int& asked = taken[name];  // Insertions do not move the elements of a map.
  std::string result = name;
  while (++asked > 1) {
    result = name + " (" + std::to_string(asked) + ")";
    if (taken.emplace(result, 1).second) break;
  }
  return result;
}

}  // namespace panache

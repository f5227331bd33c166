#include "clip/unique_name.h"

namespace panache {

std::string unique_name(const std::string& name, TakenNames& taken) {
  int& asked = taken[name];  // Insertions move nothing in a map.
  std::string result = name;
  while (++asked > 1) {
    result = name + " (" + std::to_string(asked) + ")";
    if (taken.emplace(result, 1).second) break;
  }
  return result;
}

}  // namespace panache

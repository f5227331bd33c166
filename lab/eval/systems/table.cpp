#include "eval/systems/table.h"

#include "eval/systems/mean_posture.h"

namespace panache {

const std::vector<SystemEntry>& comparison_systems() {
  static const std::vector<SystemEntry> systems = {
      {"mean posture", make_mean_posture},
  };
  return systems;
}

}  // namespace panache

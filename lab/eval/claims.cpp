#include "eval/claims.h"

#include <array>
#include <cmath>

namespace panache {
namespace {

constexpr double kShown = 0.7;
// Steps a second that are slow or quick to the eye: a usual walk has 1.8.
constexpr double kSlowSteps = 1.5, kQuickSteps = 1.9;

consteval size_t trait(std::string_view key) {
  size_t t = 0;
  while (key != kMovementTraits[t].key) ++t;
  return t;
}

// Longer words before those that are part of them.
constexpr std::array kClaims = std::to_array<Claim>({
    {"high knees", trait("knee_lift"), true},
    {"knees lifted", trait("knee_lift"), true},
    {"knees high", trait("knee_lift"), true},
    {"high kicks", trait("knee_lift"), true},
    {"arms up", trait("arms_raised"), true},
    {"arms thrown up", trait("arms_raised"), true},
    {"arms raised", trait("arms_raised"), true},
    {"arms out", trait("arms_raised"), true},
    {"hands up", trait("arms_raised"), true},
    {"arms held out", trait("arms_raised"), true},
    {"arms stretched", trait("arms_raised"), true},
    {"swinging arms", trait("arm_swing"), true},
    {"arms swing", trait("arm_swing"), true},
    {"arms that do not swing", trait("arm_swing"), false},
    {"still arms", trait("arm_swing"), false},
    {"bounc", trait("bob"), true},
    {"spring in", trait("bob"), true},
    {"bent forward", trait("lean"), true},
    {"bent far forward", trait("lean"), true},
    {"leaning forward", trait("lean"), true},
    {"leaning back", trait("lean"), false},
    {"bowed", trait("lean"), true},
    {"slow", trait("steps"), false},
    {"fast", trait("steps"), true},
    {"quick", trait("steps"), true},
    {"deep knees", trait("hip_height"), false},
    {"knees deep", trait("hip_height"), false},
    {"crouched", trait("hip_height"), false},
});

}  // namespace

std::vector<Claim> claims_of(std::string_view description) {
  std::vector<Claim> out;
  for (const Claim& claim : kClaims) {
    if (description.find(claim.words) != description.npos) out.push_back(claim);
  }
  return out;
}

std::vector<std::string> unshown(std::string_view description, const StyleArrival& style) {
  std::vector<std::string> out;
  for (const Claim& claim : claims_of(description)) {
    const ArrivedShares& walker = style.made[static_cast<size_t>(Walks::walker)];
    const bool shows = claim.trait == kStepsTrait
                           ? (claim.more ? walker.steps >= kQuickSteps : walker.steps <= kSlowSteps)
                           : (style.change[claim.trait] > 0) == claim.more &&
                                 walker.movement[claim.trait] >= kShown;
    if (shows) continue;
    out.emplace_back(claim.words);
  }
  return out;
}

}  // namespace panache

#include "takes/signature.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

namespace panache {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
constexpr double kDegrees = 180 / std::numbers::pi;
constexpr double kAgree = 0.75;    // Fraction of the actions with a change of the same sign.
constexpr double kStill = 0.05;    // m/s, added to speeds, so that a hand at rest has no sharpness.
constexpr double kStillJerk = 5;   // m/s^3
constexpr double kNoChange = 0.1;  // Relative to a trait's smallest difference.

// The forward pitch of a direction from upright.
double pitch(Vec3 up) { return std::atan2(up.z, up.y) * kDegrees; }

double bend(Vec3 upper, Vec3 lower) {
  return std::atan2(length(cross(upper, lower)), dot(upper, lower)) * kDegrees;
}

double quantile_of(std::vector<double> values, double share) {
  const auto at = values.begin() + static_cast<long>(share * (values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

Traits traits(const Take& take) {
  using enum HumanJoint;
  Traits sum{};
  std::vector<double> heights;
  double speed = 0, jerk = 0, steps = 0, jerks = 0;
  const float rate = static_cast<float>(kTakeRate);
  for (int f = 0; f < take.frames(); ++f) {
    const auto at = [&](HumanJoint joint, int back = 0) {
      return take.body[f - back][index(joint)];
    };
    sum[0] += pitch(at(neck) - at(hips));
    sum[1] += pitch(at(head) - at(neck));
    sum[2] +=
        (bend(at(left_lower_leg) - at(left_upper_leg), at(left_foot) - at(left_lower_leg)) +
         bend(at(right_lower_leg) - at(right_upper_leg), at(right_foot) - at(right_lower_leg))) /
        2;
    sum[3] +=
        (bend(at(left_lower_arm) - at(left_upper_arm), at(left_hand) - at(left_lower_arm)) +
         bend(at(right_lower_arm) - at(right_upper_arm), at(right_hand) - at(right_lower_arm))) /
        2;
    sum[4] += 100 * std::abs(at(left_foot).x - at(right_foot).x);
    sum[5] += 100 * ((at(left_hand).y + at(right_hand).y) / 2 - at(hips).y);
    for (const HumanJoint toe : {left_toes, right_toes}) heights.push_back(at(toe).y);
    for (const HumanJoint hand : {left_hand, right_hand}) {
      if (f >= 1) {
        speed += length(at(hand) - at(hand, 1)) * rate;
        ++steps;
      }
      if (f >= 3) {
        const Vec3 third = at(hand) - at(hand, 1) * 3.0f + at(hand, 2) * 3.0f - at(hand, 3);
        jerk += length(third) * rate * rate * rate;
        ++jerks;
      }
    }
  }
  Traits out;
  for (size_t t = 0; t < out.size(); ++t) out[t] = sum[t] / take.frames();
  const double log_speed = std::log(speed / std::max(1.0, steps) + kStill);
  out[6] = 100 * log_speed;
  out[7] = 100 * (std::log(jerk / std::max(1.0, jerks) + kStillJerk) - log_speed);
  out[8] = 100 * (quantile_of(heights, 0.95) - quantile_of(heights, 0.05));
  out[kTempoTrait] = 0;
  return out;
}

void SignatureMatch::add(const Signature& signature, const Traits& made) {
  for (size_t t = 0; t < kTraits.size(); ++t) {
    change[t] += made[t];
    if (!signature.certain[t]) continue;
    ++traits;
    if (std::abs(made[t]) < kNoChange * kTraits[t].min) continue;
    const double share = made[t] / signature.change[t];
    sign += share > 0;
    amount += share >= 0.5 && share <= 2;
  }
  ++takes;
}

SignatureMatch& SignatureMatch::operator+=(const SignatureMatch& other) {
  traits += other.traits;
  sign += other.sign;
  amount += other.amount;
  takes += other.takes;
  for (size_t t = 0; t < change.size(); ++t) change[t] += other.change[t];
  return *this;
}

double SignatureMatch::sign_share() const { return traits > 0 ? double(sign) / traits : kNothing; }

double SignatureMatch::amount_share() const {
  return traits > 0 ? double(amount) / traits : kNothing;
}

Traits SignatureMatch::mean_change() const {
  Traits mean;
  for (size_t t = 0; t < mean.size(); ++t) {
    mean[t] = takes > 0 ? change[t] / takes : kNothing;
  }
  return mean;
}

Signatures::Signatures(const std::vector<Take>& takes, const std::vector<Pairing>& pairings) {
  struct Mean {
    Traits sum{};
    double count = 0;
    void add(const Traits& traits) {
      for (size_t t = 0; t < sum.size(); ++t) sum[t] += traits[t];
      ++count;
    }
  };
  struct Rate {
    double log_sum = 0, count = 0;
  };
  std::vector<Rate> rates(takes.size());
  for (const Pairing& pairing : pairings) {
    for (const float rate : pairing.rates) {
      rates[pairing.styled].log_sum += 100 * std::log(std::clamp(rate, 0.33f, 3.0f));
      ++rates[pairing.styled].count;
    }
  }
  std::map<std::pair<int, std::string>, Mean> neutral;
  std::map<std::tuple<std::string, int, std::string>, Mean> styled;
  for (size_t i = 0; i < takes.size(); ++i) {
    const ManifestRow& row = takes[i].row;
    Traits found = traits(takes[i]);
    if (row.neutral) {
      neutral[{row.set, row.content}].add(found);
    } else if (rates[i].count > 0) {
      found[kTempoTrait] = rates[i].log_sum / rates[i].count;
      styled[{row.style, row.set, row.content}].add(found);
    }
  }
  for (const auto& [key, mean] : styled) {
    const auto& [style, set, content] = key;
    const auto base = neutral.find({set, content});
    if (base == neutral.end()) continue;
    Traits change;
    for (size_t t = 0; t < change.size(); ++t) {
      change[t] = mean.sum[t] / mean.count - base->second.sum[t] / base->second.count;
    }
    actions_[style].push_back(change);
  }
  for (const auto& [style, actions] : actions_) {
    if (actions.size() >= 2) signatures_[style] = agree(actions);
  }
}

Signature Signatures::agree(const std::vector<Traits>& actions) {
  Signature signature;
  for (size_t t = 0; t < kTraits.size(); ++t) {
    double sum = 0, squares = 0;
    for (const Traits& action : actions) sum += action[t];
    const double mean = sum / actions.size();
    for (const Traits& action : actions) squares += (action[t] - mean) * (action[t] - mean);
    signature.deviation[t] = std::sqrt(squares / actions.size());
    const auto same = std::count_if(actions.begin(), actions.end(),
                                    [&](const Traits& action) { return action[t] * mean > 0; });
    signature.change[t] = mean;
    signature.certain[t] = std::abs(mean) >= kTraits[t].min && same >= kAgree * actions.size();
  }
  return signature;
}

const Signature* Signatures::find(const std::string& style) const {
  const auto found = signatures_.find(style);
  return found == signatures_.end() ? nullptr : &found->second;
}

SignatureMatch Signatures::real(const std::string& style) const {
  SignatureMatch match;
  const auto found = actions_.find(style);
  if (found == actions_.end() || found->second.size() < 3) return match;
  for (size_t left_out = 0; left_out < found->second.size(); ++left_out) {
    std::vector<Traits> others = found->second;
    others.erase(others.begin() + left_out);
    match.add(agree(others), found->second[left_out]);
  }
  return match;
}

}  // namespace panache

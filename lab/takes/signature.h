#pragma once
// A style described by traits: how posture, speed and tempo of its real takes differ from neutral
// takes of the same action. It shows what is missing, where a classifier only shows that something
// is.

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "learn/pairing.h"
#include "learn/take.h"

namespace panache {

// The traits of a take, in order.
struct Trait {
  const char* key;    // In report.json.
  const char* label;  // For people, with the unit.
  double min;         // Smaller differences are ignored.
};
inline constexpr std::array kTraits = std::to_array<Trait>({
    {"lean", "lean forward, degrees", 3},
    {"head", "head pitched forward, degrees", 3},
    {"knees", "knees bent, degrees", 4},
    {"elbows", "elbows bent, degrees", 5},
    {"stance", "feet apart sideways, cm", 2},
    {"hands", "hands above the hips, cm", 3},
    {"speed", "speed of the hands, %", 10},
    {"sharpness", "sharpness of the hands, %", 10},
    {"clearance", "feet lifted, cm", 1},
    {"tempo", "tempo, %", 5},
});
inline constexpr size_t kTempoTrait = kTraits.size() - 1;
// The index of a key in the table.
consteval size_t trait_index(std::string_view key) {
  size_t t = 0;
  while (key != kTraits[t].key) ++t;
  return t;
}
using Traits = std::array<double, kTraits.size()>;

// Means over the frames of a take; percentages as 100 log, so that their differences are changes.
// The tempo is 0, because a take alone does not determine it.
Traits traits(const Take& take);

// The changes of a style on which its real takes agree.
struct Signature {
  Traits change{}, deviation{};                // Mean and deviation over the actions.
  std::array<bool, kTraits.size()> certain{};  // Most actions agree on a sizeable change.
};

// Comparison of the outputs' traits with a signature.
struct SignatureMatch {
  size_t traits = 0;  // Number of compared traits,
  size_t sign = 0;    // of those with the right sign,
  size_t amount = 0;  // and of those with half to double the real change.
  Traits change{};    // Sum over the outputs, for all traits.
  size_t takes = 0;   // Number of outputs.

  void add(const Signature& signature, const Traits& change);
  SignatureMatch& operator+=(const SignatureMatch& other);
  // NaN if nothing was compared.
  double sign_share() const;
  double amount_share() const;
  Traits mean_change() const;
};

class Signatures {
 public:
  // From real takes: each style relative to the neutral takes of the same set and content. The
  // tempo is that of the pairings.
  Signatures(const std::vector<Take>& takes, const std::vector<Pairing>& pairings);

  // Null if the style does not have takes of at least two actions.
  const Signature* find(const std::string& style) const;
  // How each real action matches what the others agree on: an upper bound for outputs.
  SignatureMatch real(const std::string& style) const;

 private:
  static Signature agree(const std::vector<Traits>& actions);
  std::map<std::string, std::vector<Traits>> actions_;  // Changes of each style, one per action.
  std::map<std::string, Signature> signatures_;
};

}  // namespace panache

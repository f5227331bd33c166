#pragma once
// Options of stylize for persons: --person, --seed and --variety.

#include <cstdint>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "messages.h"
#include "style/model.h"

namespace panache::cli {

struct PersonFlags {
  std::string person;        // A number, a word or "random", as typed; empty: nobody.
  std::optional<uint32_t> seed;  // For "random".
  std::optional<float> variety;

  bool given() const { return !person.empty(); }
};
// `flags` must outlive the verb.
void add_person_options(CLI::App& verb, PersonFlags& flags);

// The persons to put on files.
struct PersonWish {
  std::string given;                  // As typed: "7", "mara" or "random".
  std::optional<uint32_t> seed;       // Nothing: another one for each file.
  uint32_t random_seed = 0;
  float variety = 1;

  // The person's seed for a file.
  uint32_t seed_for(const std::string& file) const;
};

// The wish, if any. Throws Failure: if the model has no persons, or if an option that needs --person
// is alone.
std::optional<PersonWish> read_person_options(const PersonFlags& flags, const Model& model);

}  // namespace panache::cli

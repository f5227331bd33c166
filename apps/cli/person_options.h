#pragma once
// Options of stylize and live for persons: --person, --seed and --variety.

#include <cstdint>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "messages.h"
#include "style/model/model.h"
#include "style/model/person.h"

namespace panache::cli {

struct PersonFlags {
  // A number, a word, "random" or numbers with commas, as typed; empty: nobody.
  std::string person;
  std::optional<uint32_t> seed;  // For "random".
  std::optional<float> variety;

  bool given() const { return !person.empty(); }
};
// `flags` must outlive the verb.
void add_person_options(CLI::App& verb, PersonFlags& flags);

// The persons to put on files, or on senders, by their order from 1 on instead of a file.
struct PersonWish {
  std::string given;                     // As typed: "7", "mara", "random" or "0.5,-1,...".
  std::optional<PersonNumbers> numbers;  // If these were given.
  std::optional<uint32_t> seed;          // Nothing: another one for each file.
  uint32_t random_seed = 0;
  float variety = 1;

  // The person's seed for a file, without numbers.
  uint32_t seed_for(const std::string& file) const;
  // The person's numbers for a file.
  PersonNumbers numbers_for(const std::string& file, const Model& model) const;
  // "person 7"
  std::string describe(const std::string& file) const;
};

// The wish, if any. Throws Failure: if the model has no persons, or if an option that needs
// --person is alone.
std::optional<PersonWish> read_person_options(const PersonFlags& flags, const Model& model);

}  // namespace panache::cli

#pragma once
// Fits the space of persons of a model (style/model/person.h) to the neutral motion of many people.

#include <map>
#include <string>
#include <vector>

#include "base/result.h"
#include "learn/neutral_bank.h"
#include "learn/take.h"
#include "net/safetensors.h"
#include "style/model/person.h"

namespace panache {

struct PersonSettings {
  int axes = 8;
  int units = 24;  // Combinations of activations that the axes share.
  // The cost of a squared weight of a person's regression, in variances of an activation.
  double penalty = 3;
};

// What an axis is named after, and how well it follows that, over the people it was fitted to.
struct PersonAxis {
  std::string name;
  double correlation = 0;
  double share = 0;  // Of the spread of the people.
};

struct FittedPersons {
  std::map<std::string, Tensor> tensors;  // person.*, see PersonSpace.
  std::vector<PersonAxis> axes;
  // The numbers of each person, and the seconds of motion that were matched.
  std::map<std::string, PersonNumbers> people;
  std::map<std::string, double> seconds;
  double kept = 0;  // Share of the spread of people that the axes carry.
};

// The performer of a take: of the manifest, or the file's name up to the first '_'.
std::string person_of(const Take& take);
// Whether a take shows an ordinary walk or run.
bool is_gait(const Take& take);

// Fits to takes that are not marked test, neutral and in layout positions. `model` must be able to
// learn styles; `bank`: what other people do at each moment. Fails if too few people walk.
Result<FittedPersons> fit_persons(const TensorFile& model, const NeutralBank& bank,
                                  const std::vector<Take>& takes, const PersonSettings& settings);

// The model with these persons in the place of those it had; in int8 if its networks are. Their
// change is multiplied by `gain`.
TensorFile with_persons(const TensorFile& model, const FittedPersons& persons, double gain);

}  // namespace panache

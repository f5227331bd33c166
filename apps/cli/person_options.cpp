#include "person_options.h"

#include <algorithm>
#include <filesystem>

#include "base/text.h"
#include "clip/text_cursor.h"
#include "program.h"
#include "strengths.h"
#include "style/model/person.h"

namespace panache::cli {
namespace {

constexpr const char* kRandom = "random";

// Numbers with commas between them, one for each axis.
PersonNumbers numbers_of(const std::string& text, const Model& model) {
  const std::vector<std::string>& names = model.persons()->names();
  PersonNumbers out{};
  size_t count = 0;
  for (size_t at = 0; at <= text.size(); ++count) {
    const size_t end = std::min(text.find(',', at), text.size());
    const std::optional<double> number = parse_number(text.substr(at, end - at));
    if (!number || count >= names.size()) {
      count = names.size() + 1;
      break;
    }
    out[count] = std::clamp(static_cast<float>(*number), -kMaxPerson, kMaxPerson);
    at = end + 1;
  }
  if (count == names.size()) return out;
  throw Failure{
      {"--person " + panache::quoted(text) + ": expected " + std::to_string(names.size()) +
       " numbers (" + one_of(names, ", ") + "), a seed or a word"},
      kBadUsage};
}

}  // namespace

void add_person_options(CLI::App& verb, PersonFlags& flags) {
  add_option(
      verb, "--person SEED", flags.person,
      "Move as another person, in addition to the styles: a\nnumber or a word, each is another "
      "one. random: another\none for each file or sender. Or the numbers that\npanache learn "
      "--person prints");
  add_option(verb, "--seed NUMBER", flags.seed,
             "Other random persons; equal seeds give equal persons.\nDefault: 0");
  add_option(verb, "--variety AMOUNT", flags.variety,
             "How far the person is from the mean of people: 0 (not\nat all) to 2; default: 1, as "
             "real people differ")
      ->check(in_range(0, static_cast<double>(kMaxVariety)));
}

uint32_t PersonWish::seed_for(const std::string& file) const {
  if (seed) return *seed;
  const std::string path = std::filesystem::path(file).lexically_normal().generic_string();
  return person_seed(std::to_string(random_seed) + ":" + path);
}

PersonNumbers PersonWish::numbers_for(const std::string& file, const Model& model) const {
  if (!numbers) return person_of_seed(model, seed_for(file), variety);
  PersonNumbers out = *numbers;
  for (float& number : out) number *= variety;
  return out;
}

std::string PersonWish::describe(const std::string& file) const {
  return "person " + (numbers ? given : std::to_string(seed_for(file)));
}

std::optional<PersonWish> read_person_options(const PersonFlags& flags, const Model& model) {
  if (!flags.given()) {
    if (flags.seed)
      throw Failure{{"--seed: is for random persons; add --person random"}, kBadUsage};
    if (flags.variety) throw Failure{{"--variety: nobody is asked for; add --person"}, kBadUsage};
    return std::nullopt;
  }
  const bool random = flags.person == kRandom;
  if (flags.seed && !random) {
    throw Failure{{"--seed: --person " + panache::quoted(flags.person) +
                   " is one person; expected --person random"},
                  kBadUsage};
  }
  if (Result<void> good = check_has_persons(model); !good) {
    throw Failure{{"--person: " + good.error().message}, kBadInput};
  }
  PersonWish wish;
  wish.given = flags.person;
  wish.variety = flags.variety.value_or(1);
  wish.random_seed = flags.seed.value_or(0);
  if (flags.person.find(',') != std::string::npos) {
    wish.numbers = numbers_of(flags.person, model);
  } else if (!random) {
    wish.seed = person_seed(flags.person);
  }
  return wish;
}

}  // namespace panache::cli

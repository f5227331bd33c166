#include "train/persons.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>

#include <torch/torch.h>

#include "base/parallel.h"
#include "learn/fit_style.h"
#include "learn/learn_person.h"
#include "net/layer.h"
#include "recipes/recipe.h"
#include "style/networks/networks.h"
#include "style/stages/shaping.h"
#include "train/network.h"

namespace panache {
namespace {

using enum HumanJoint;

constexpr int kShortest = 45;                    // Frames of a take.
constexpr int kMaxGait = 1500, kMaxOther = 750;  // Samples of a person.
constexpr double kMinGaitSeconds = 2;
constexpr int kCommonGait = 400, kCommonOther = 400;  // Windows on which people are compared.
// A tempo that is faster by this logarithm counts as much as joints one centimetre away.
constexpr double kTempoUnit = 0.05;
constexpr int kMinPeople = 20;
constexpr double kOutlier = 3;  // In median distances from the mean person.

// At most `count` of a list, evenly spaced.
std::vector<size_t> thinned(const std::vector<size_t>& list, size_t count) {
  if (list.size() <= count) return list;
  std::vector<size_t> out;
  for (size_t i = 0; i < count; ++i) out.push_back(list[i * list.size() / count]);
  return out;
}

// One person's regression: the head of a learnt style.
struct PersonHead {
  std::string name;
  torch::Tensor weights, bias;  // [activations][kLearntOutputs], [kLearntOutputs]
  double seconds = 0;
};

torch::Tensor matrix(const Tensor& tensor) {
  return torch::tensor(tensor.values).reshape(tensor.shape).to(torch::kFloat64);
}

// Windows of many people's motion, to compare persons on.
struct Common {
  std::vector<HumanPositions> bodies;
  std::vector<std::array<float, kRootFeatures>> roots;
  torch::Tensor activations;  // [windows][activations]
};

Common common_windows(const std::shared_ptr<const Model>& model, const std::vector<Take>& takes,
                      int count, Random& random) {
  const StyleNetworks networks(model);
  const int numbers = pose_feature_count(model->layout());
  std::vector<float> window(size_t(kWindowPoses) * numbers), activations(model->activation_count());
  Common out;
  std::vector<torch::Tensor> rows;
  for (int i = 0; i < count; ++i) {
    const Take& take = takes[random.below(static_cast<uint32_t>(takes.size()))];
    const auto frame =
        static_cast<float>(8 + random.below(static_cast<uint32_t>(take.frames() - 8)));
    take_window(take, frame, numbers, window);
    networks.activations(window, activations);
    rows.push_back(torch::tensor(activations).to(torch::kFloat64));
    out.bodies.push_back(body_at(take, frame));
    out.roots.push_back(root_at(take, frame));
  }
  out.activations = torch::stack(rows);
  return out;
}

// The bodies of common windows as a person would hold them, and the person's tempo.
struct PersonBodies {
  std::vector<HumanPositions> bodies;
  double log_rate = 0;  // Mean.
};
PersonBodies bodies_of_person(const Model& model, const Common& common,
                              const torch::Tensor& weights, const torch::Tensor& bias) {
  const torch::Tensor answers =
      (common.activations.matmul(weights) + bias).to(torch::kFloat32).contiguous();
  PersonBodies out;
  for (size_t w = 0; w < common.bodies.size(); ++w) {
    const float* answer = answers.data_ptr<float>() + w * kLearntOutputs;
    std::vector<float> scaled(StyleDelta::kSize);
    for (size_t i = 0; i < scaled.size(); ++i) scaled[i] = answer[i] * model.output_scale()[i];
    const StyleDelta delta = model.recipe().to_change(scaled, common.bodies[w], common.roots[w]);
    out.bodies.push_back(change_body(common.bodies[w], delta));
    out.log_rate += static_cast<double>(answer[StyleDelta::kSize]) / double(common.bodies.size());
  }
  return out;
}

// What can be seen of a person on the common walks; each is the name of an axis.
struct VisibleTrait {
  const char* name;
  double (*measure)(const PersonBodies&);
};
double mean_over(const PersonBodies& person,
                 const std::function<double(const HumanPositions&)>& of) {
  double sum = 0;
  for (const HumanPositions& body : person.bodies) sum += of(body);
  return sum / static_cast<double>(person.bodies.size());
}
double deviation_over(const PersonBodies& person,
                      const std::function<double(const HumanPositions&)>& of) {
  const double mean = mean_over(person, of);
  return std::sqrt(mean_over(
      person, [&](const HumanPositions& body) { return (of(body) - mean) * (of(body) - mean); }));
}
double ahead(const HumanPositions& body, HumanJoint joint) { return double{body[index(joint)].z}; }
double height(const HumanPositions& body, HumanJoint joint) { return double{body[index(joint)].y}; }
double left(const HumanPositions& body, HumanJoint joint) { return double{body[index(joint)].x}; }
constexpr std::array<VisibleTrait, 8> kVisible = {{
    {"stride",
     [](const PersonBodies& person) {
       return deviation_over(person, [](const HumanPositions& body) {
         return ahead(body, left_foot) - ahead(body, right_foot);
       });
     }},
    {"arm swing",
     [](const PersonBodies& person) {
       return deviation_over(person, [](const HumanPositions& body) {
         return ahead(body, left_hand) - ahead(body, right_hand);
       });
     }},
    {"stance",
     [](const PersonBodies& person) {
       return mean_over(person, [](const HumanPositions& body) {
         return left(body, left_foot) - left(body, right_foot);
       });
     }},
    {"carriage",
     [](const PersonBodies& person) {
       return mean_over(person, [](const HumanPositions& body) {
         return ahead(body, head) - ahead(body, hips);
       });
     }},
    {"bounce",
     [](const PersonBodies& person) {
       return deviation_over(person, [](const HumanPositions& body) { return height(body, hips); });
     }},
    {"side",
     [](const PersonBodies& person) {
       return mean_over(person, [](const HumanPositions& body) {
         return height(body, left_hand) - height(body, right_hand);
       });
     }},
    {"elbows",
     [](const PersonBodies& person) {
       return mean_over(person, [](const HumanPositions& body) {
         return height(body, left_hand) + height(body, right_hand);
       });
     }},
    {"pace", [](const PersonBodies& person) { return person.log_rate; }},
}};

// A person as one row of numbers: all joints on all common windows and the tempo, so that squared
// distances are mean squared centimetres of a joint.
torch::Tensor row_of(const PersonBodies& person) {
  const double unit = 100 / std::sqrt(double(kHumanJoints) * double(person.bodies.size()));
  std::vector<double> row;
  for (const HumanPositions& body : person.bodies) {
    for (const Vec3& joint : body) {
      for (const float at : {joint.x, joint.y, joint.z}) row.push_back(unit * double{at});
    }
  }
  row.push_back(person.log_rate / kTempoUnit);
  return torch::tensor(row, torch::kFloat64);
}

Tensor file_tensor(const torch::Tensor& values, bool half) {
  Tensor out = to_tensor(values.to(torch::kFloat32).contiguous(), half);
  if (half) {
    for (float& value : out.values) value = from_half(to_half(value));
  }
  return out;
}

}  // namespace

std::string person_of(const Take& take) {
  if (!take.row.person.empty()) return take.row.person;
  const std::string file = std::filesystem::path(take.row.path).stem().string();
  return file.substr(0, file.find('_'));
}

bool is_gait(const Take& take) {
  const std::string& content = take.row.content;
  const auto has = [&](const char* word) { return content.find(word) != std::string::npos; };
  const bool odd = has("back") || has("side") || has("uneven") || has("human") || has("duck") ||
                   has("jump") || has("stealth") || has("sneak") || has("drunk") || has("hobble");
  return (has("walk") || has("run") || has("jog") || has("navigate")) && !odd;
}

Result<FittedPersons> fit_persons(const TensorFile& file, const NeutralBank& bank,
                                  const std::vector<Take>& takes, const PersonSettings& settings) {
  torch::NoGradGuard no_gradients;
  Result<std::shared_ptr<const Model>> read = Model::create(file, "the model");
  if (!read) return read.error();
  const std::shared_ptr<const Model>& model = *read;
  if (!model->can_learn()) return Error{"the model cannot learn styles, and so no persons"};

  std::map<std::string, std::vector<const Take*>> by_person;
  std::vector<Take> gaits, others;
  for (const Take& take : takes) {
    if (take.row.test || !take.row.neutral || take.frames() < kShortest) continue;
    by_person[person_of(take)].push_back(&take);
    (is_gait(take) ? gaits : others).push_back(take);
  }
  if (gaits.empty() || others.empty()) {
    return Error{"no neutral takes of walks and of other actions were found; persons need both"};
  }

  std::vector<std::pair<std::string, std::vector<const Take*>>> people(by_person.begin(),
                                                                       by_person.end());
  std::vector<PersonHead> fitted(people.size());
  for (size_t p = 0; p < people.size(); ++p) {
    const std::vector<const Take*>& own = people[p].second;
    std::vector<PersonMatch> found(own.size());
    parallel_for(static_cast<int>(own.size()),
                 [&](int t) { found[t] = match_person(bank, *own[t]); });
    std::vector<Take> all;
    std::vector<Pairing> pairings;
    for (PersonMatch& matched : found) {
      if (matched.takes.empty()) continue;
      const auto first = static_cast<int>(all.size());
      for (Take& take : matched.takes) all.push_back(std::move(take));
      for (Pairing& pairing : matched.pairings) {
        pairing.neutral += first, pairing.styled += first;
        pairings.push_back(std::move(pairing));
      }
    }
    const SampleSet set(all, pairings, {"person"}, model->recipe(), false);
    std::vector<size_t> gait, other;
    for (size_t i = 0; i < set.samples().size(); ++i) {
      (is_gait(all[set.samples()[i].styled]) ? gait : other).push_back(i);
    }
    PersonHead& head = fitted[p];
    head.name = people[p].first;
    // Windows overlap threefold.
    head.seconds = double(gait.size()) / kTakeRate / 3;
    if (head.seconds < kMinGaitSeconds) continue;
    std::vector<size_t> chosen = thinned(gait, kMaxGait);
    const std::vector<size_t> more = thinned(other, std::min<size_t>(kMaxOther, chosen.size()));
    chosen.insert(chosen.end(), more.begin(), more.end());
    const TensorFile fit = fit_style(model, set, chosen, settings.penalty);
    head.weights = matrix(fit.tensors.at("head.weight"));
    head.bias = matrix(fit.tensors.at("head.bias"));
  }
  std::erase_if(fitted, [](const PersonHead& head) { return !head.weights.defined(); });

  Random random(1);
  const Common walks = common_windows(model, gaits, kCommonGait, random);
  const Common rest = common_windows(model, others, kCommonOther, random);
  // People who are far from all others acted, or were captured with another pose at rest.
  std::vector<PersonBodies> persons;
  std::vector<torch::Tensor> rows;
  for (const PersonHead& head : fitted) {
    persons.push_back(bodies_of_person(*model, walks, head.weights, head.bias));
    rows.push_back(row_of(persons.back()));
  }
  if (rows.empty()) return Error{"nobody among the takes walks for long enough"};
  const torch::Tensor middle = std::get<0>(torch::stack(rows).median(0));
  const torch::Tensor far = (torch::stack(rows) - middle).norm(2, 1);
  const double usual = far.median().item<double>();
  for (size_t p = fitted.size(); p-- > 0;) {
    if (far[static_cast<int64_t>(p)].item<double>() <= kOutlier * usual) continue;
    fitted.erase(fitted.begin() + static_cast<int64_t>(p));
    persons.erase(persons.begin() + static_cast<int64_t>(p));
    rows.erase(rows.begin() + static_cast<int64_t>(p));
  }
  const auto count = static_cast<int64_t>(fitted.size());
  if (count < kMinPeople) {
    return Error{"only " + std::to_string(count) + " people walk; expected at least " +
                 std::to_string(kMinPeople)};
  }

  // Principal components of the people (Pearson 1901).
  const int64_t axes = settings.axes;
  torch::Tensor all = torch::stack(rows);
  all = all - all.mean(0);
  const auto [values, vectors] = torch::linalg_eigh(all.matmul(all.t()));
  torch::Tensor numbers =  // Of unit variance. [people][axes]
      vectors.slice(1, count - axes).flip(1) * std::sqrt(double(count - 1));
  FittedPersons out;
  out.kept = (values.slice(0, count - axes).sum() / values.sum()).item<double>();

  // Turns the axes to what is visible: the orthogonal matrix nearest to the correlations with the
  // traits (Schönemann 1966).
  std::vector<torch::Tensor> columns;
  for (const VisibleTrait& trait : kVisible) {
    std::vector<double> column;
    for (const PersonBodies& one : persons) column.push_back(trait.measure(one));
    const torch::Tensor values_of = torch::tensor(column, torch::kFloat64);
    columns.push_back((values_of - values_of.mean()) / (values_of.std() + 1e-12));
  }
  const torch::Tensor traits = torch::stack(columns, 1);  // [people][traits]
  const torch::Tensor correlations = traits.t().matmul(numbers) / double(count - 1);
  const auto [u, s, vh] = torch::linalg_svd(correlations, false);
  const torch::Tensor turn = u.matmul(vh);  // [traits][axes]
  if (axes == static_cast<int64_t>(kVisible.size())) numbers = numbers.matmul(turn.t());
  const torch::Tensor follows = (traits.t().matmul(numbers) / double(count - 1)).diag();

  // The axes' heads: the regression of the people's heads on their numbers.
  std::vector<torch::Tensor> weights, biases;
  for (const PersonHead& head : fitted) {
    weights.push_back(head.weights);
    biases.push_back(head.bias);
  }
  const torch::Tensor heads = torch::stack(weights), offsets = torch::stack(biases);
  const auto along = [&](const torch::Tensor& of_people) {
    const torch::Tensor flat = of_people.reshape({count, -1});
    return (numbers.t().matmul(flat - flat.mean(0)) / double(count - 1));
  };
  const int64_t activations = heads.size(1), outputs = heads.size(2);
  const torch::Tensor axis_heads = along(heads).reshape({axes, activations, outputs});
  const torch::Tensor axis_offsets = along(offsets);  // [axes][outputs]

  // What all axes read: the combinations of activations that matter most to their outputs.
  const torch::Tensor mixture = torch::cat({walks.activations, rest.activations});
  const torch::Tensor mean = mixture.mean(0);
  const torch::Tensor centred = mixture - mean;
  const torch::Tensor importance = torch::ones({outputs}, torch::kFloat64);
  for (int64_t o = 0; o < StyleDelta::kSize; ++o) {
    importance[o] = double{model->output_scale()[static_cast<size_t>(o)]};
  }
  importance[StyleDelta::kSize] = 0.3;
  importance.slice(0, StyleDelta::kSize + 1).fill_(0.02);
  const torch::Tensor stacked =  // [activations][axes * outputs]
      (axis_heads * importance).permute({1, 0, 2}).reshape({activations, axes * outputs});
  const torch::Tensor answers = centred.matmul(stacked) / std::sqrt(double(mixture.size(0)));
  const auto [au, as, avh] = torch::linalg_svd(answers, false);
  const int64_t units = settings.units;
  const torch::Tensor reduce =
      stacked.matmul(avh.slice(0, 0, units).t()) / as.slice(0, 0, units);  // [activations][units]
  const torch::Tensor reduced = centred.matmul(reduce);
  // Least squares of the answers on the units.
  const torch::Tensor exact =
      centred.matmul(axis_heads.permute({1, 0, 2}).reshape({activations, axes * outputs}));
  const torch::Tensor fit =
      torch::linalg_solve(reduced.t().matmul(reduced) + 1e-9 * torch::eye(units, torch::kFloat64),
                          reduced.t().matmul(exact));  // [units][axes * outputs]
  const torch::Tensor dynamic = fit.reshape({units, axes, outputs}).permute({1, 0, 2});
  const torch::Tensor posture =
      torch::matmul(mean, axis_heads).reshape({axes, 1, outputs}) + axis_offsets.unsqueeze(1);
  const torch::Tensor head = torch::cat({dynamic, posture}, 1).reshape({-1, outputs});

  const Tensor stored = file_tensor(reduce, true);
  out.tensors["person.reduce.weight"] = stored;
  out.tensors["person.reduce.bias"] = file_tensor(-mean.matmul(matrix(stored)), false);
  out.tensors["person.head.weight"] = file_tensor(head, true);
  out.tensors["person.head.bias"] = file_tensor(torch::zeros({outputs}), false);
  const torch::Tensor shares = (numbers.t().matmul(all) / double(count - 1)).square().sum(1) /
                               (all.square().sum() / double(count - 1));
  for (int64_t a = 0; a < axes; ++a) {
    const bool named = axes == static_cast<int64_t>(kVisible.size());
    out.axes.push_back(
        {named ? kVisible[static_cast<size_t>(a)].name : "axis " + std::to_string(a + 1),
         named ? follows[a].item<double>() : 0, shares[a].item<double>()});
  }
  for (int64_t p = 0; p < count; ++p) {
    const PersonHead& person = fitted[static_cast<size_t>(p)];
    PersonNumbers& of = out.people[person.name];
    of = {};
    for (int64_t a = 0; a < axes; ++a) {
      of[static_cast<size_t>(a)] = numbers[p][a].item<float>();
    }
    out.seconds[person.name] = person.seconds;
  }
  return out;
}

TensorFile with_persons(const TensorFile& model, const FittedPersons& persons, double gain) {
  TensorFile out = model;
  std::erase_if(out.tensors,
                [](const auto& tensor) { return tensor.first.starts_with("person."); });
  TensorFile part;
  part.tensors = persons.tensors;
  for (float& value : part.tensors["person.head.weight"].values) {
    value = from_half(to_half(static_cast<float>(gain * double{value})));
  }
  if (is_quantized(model)) part = quantize(part);
  for (auto& [key, tensor] : part.tensors) out.tensors[key] = std::move(tensor);
  std::string names;
  for (const PersonAxis& axis : persons.axes) names += (names.empty() ? "" : "\n") + axis.name;
  out.metadata["person_axes"] = names;
  return out;
}

}  // namespace panache

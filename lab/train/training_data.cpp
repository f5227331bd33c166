#include "train/training_data.h"

#include <map>
#include <tuple>

#include "base/progress.h"
#include "takes/load_takes.h"
#include "train/matrix_products.h"

namespace panache {
namespace {

// FNV-1a of the file's name.
uint32_t hash_of_name(const std::string& path) {
  uint32_t hash = 2166136261u;
  for (const char c : path.substr(path.find_last_of('/') + 1)) {
    hash = (hash ^ static_cast<uint8_t>(c)) * 16777619u;
  }
  return hash;
}

}  // namespace

std::vector<bool> validation_takes(const std::vector<Take>& takes) {
  using Cell = std::tuple<int, std::string, std::string>;  // Set, style, content.
  std::map<Cell, std::vector<size_t>> cells;
  for (size_t t = 0; t < takes.size(); ++t) {
    const ManifestRow& row = takes[t].row;
    cells[{row.set, row.style, row.content}].push_back(t);
  }
  std::vector<bool> validates(takes.size());
  for (const auto& [cell, members] : cells) {
    bool trains = false;
    for (const size_t t : members) {
      validates[t] = hash_of_name(takes[t].row.path) % 20 == 0;
      trains = trains || !validates[t];
    }
    if (!trains) validates[members.front()] = false;
  }
  return validates;
}

Result<std::vector<Take>> read_training_takes(const std::vector<ManifestRow>& rows,
                                              PoseLayout layout, const std::string& what) {
  std::vector<ManifestRow> used;
  for (const ManifestRow& row : rows) {
    if (!row.test) used.push_back(row);
  }
  Progress progress(what);
  return load_takes(used, layout, [&](int done) {
    progress.update(static_cast<double>(done) / static_cast<double>(used.size()));
  });
}

Result<TrainingData> prepare_training(const std::vector<ManifestRow>& rows, PoseLayout layout,
                                      const std::vector<ManifestRow>& unlabelled) {
  if (Result<void> prepared = prepare_matrix_products(); !prepared) return prepared.error();
  TrainingData data;
  const Stopwatch reading;
  Result<std::vector<Take>> takes = read_training_takes(rows, layout, "reading");
  if (!takes) return takes.error();
  data.takes = *std::move(takes);
  takes = read_training_takes(unlabelled, layout, "reading unlabelled motion");
  if (!takes) return takes.error();
  data.unlabelled = *std::move(takes);
  data.read_seconds = reading.seconds();
  std::vector<int> styled, neutral;
  for (size_t i = 0; i < data.takes.size(); ++i) {
    (data.takes[i].row.neutral ? neutral : styled).push_back(static_cast<int>(i));
  }
  if (neutral.empty()) return Error{"no neutral take to learn from; expected rows with neutral 1"};
  if (styled.empty()) return Error{"no styled take to learn from; expected rows with neutral 0"};
  const Stopwatch pairing;
  Progress progress("pairing");
  data.pairings =
      pair_takes(data.takes, styled, neutral, {}, [&](double share) { progress.update(share); });
  data.pair_seconds = pairing.seconds();
  if (data.pairings.empty()) {
    return Error{"no styled take has a neutral take of the same content in its manifest"};
  }
  return data;
}

}  // namespace panache

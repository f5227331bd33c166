#include "train/checkpoint.h"

#include <filesystem>

namespace panache {
namespace {

std::string file_of(const std::string& path, const std::string& network) {
  return path + "." + network + ".checkpoint";
}

}  // namespace

void save_checkpoint(const std::string& path, uint64_t fingerprint, const NetworkTrainer& network,
                     const std::vector<LossPoint>& losses) {
  std::vector<torch::Tensor> saved = network.save();
  torch::Tensor table = torch::zeros({static_cast<int64_t>(losses.size()), 3}, torch::kFloat64);
  auto rows = table.accessor<double, 2>();
  for (size_t i = 0; i < losses.size(); ++i) {
    rows[i][0] = static_cast<double>(losses[i].step);
    rows[i][1] = losses[i].train;
    rows[i][2] = losses[i].validation;
  }
  saved.push_back(table);
  saved.push_back(torch::tensor(static_cast<int64_t>(fingerprint)));
  const std::string file = file_of(path, network.shape().name);
  torch::save(saved, file + ".part");
  std::filesystem::rename(file + ".part", file);
}

Result<void> load_checkpoint(const std::string& path, uint64_t fingerprint, NetworkTrainer& network,
                             std::vector<LossPoint>& losses) {
  const std::string file = file_of(path, network.shape().name);
  if (!std::filesystem::exists(file)) return {};
  std::vector<torch::Tensor> saved;
  try {
    torch::load(saved, file);
  } catch (const std::exception&) {
    return Error{file + ": is damaged; delete it to train from the start"};
  }
  if (saved.size() != 6 || saved[5].item<int64_t>() != static_cast<int64_t>(fingerprint) ||
      !network.restore({saved.begin(), saved.begin() + 4})) {
    return Error{file +
                 ": was begun with other data or settings; delete it to train from the start"};
  }
  const auto rows = saved[4].accessor<double, 2>();
  for (int64_t i = 0; i < rows.size(0); ++i) {
    losses.push_back({network.shape().name, static_cast<int64_t>(rows[i][0]),
                      static_cast<float>(rows[i][1]), static_cast<float>(rows[i][2])});
  }
  return {};
}

void remove_checkpoints(const std::string& path) {
  for (const char* network : {"pose", "timing", "contact"}) {
    std::error_code ignored;
    std::filesystem::remove(file_of(path, network), ignored);
  }
}

}  // namespace panache

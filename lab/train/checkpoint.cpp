#include "train/checkpoint.h"

#include <filesystem>
#include <sstream>
#include <utility>

#include <torch/serialize.h>

#include "base/file.h"

namespace panache {
namespace {

std::string file_of(const std::string& path, const std::string& network) {
  return path + "." + network + ".checkpoint";
}

torch::Tensor as_tensor(const Fingerprint& training) {
  return torch::tensor({static_cast<int64_t>(training.data), static_cast<int64_t>(training.styles),
                        static_cast<int64_t>(training.settings)});
}

// How another training differs from this one, "" if it does not. Other styles change the data, and
// may change the settings; so the first difference in this order is the cause.
std::string difference(const torch::Tensor& saved, const torch::Tensor& now) {
  constexpr std::pair<int, const char*> kParts[] = {{2, "settings"}, {1, "styles"}, {0, "data"}};
  for (const auto& [index, name] : kParts) {
    if (saved[index].item<int64_t>() != now[index].item<int64_t>()) return name;
  }
  return "";
}

}  // namespace

Result<void> save_checkpoint(const std::string& path, const Fingerprint& training,
                             const NetworkTrainer& network, const std::vector<LossPoint>& losses) {
  std::vector<torch::Tensor> saved = network.save();
  torch::Tensor table = torch::zeros({static_cast<int64_t>(losses.size()), 3}, torch::kFloat64);
  auto rows = table.accessor<double, 2>();
  for (size_t i = 0; i < losses.size(); ++i) {
    rows[i][0] = static_cast<double>(losses[i].step);
    rows[i][1] = losses[i].train;
    rows[i][2] = losses[i].validation;
  }
  saved.push_back(table);
  saved.push_back(as_tensor(training));
  // Without libtorch, which aborts if the disk is full.
  std::ostringstream bytes;
  torch::save(saved, bytes);
  return write_file(file_of(path, network.shape().name), bytes.view(), true);
}

Result<void> load_checkpoint(const std::string& path, const Fingerprint& training,
                             NetworkTrainer& network, std::vector<LossPoint>& losses) {
  const std::string file = file_of(path, network.shape().name);
  if (!std::filesystem::exists(file)) return {};
  const Error damaged{file + ": is damaged; delete it to train from the start"};
  std::vector<torch::Tensor> saved;
  try {
    torch::load(saved, file);
  } catch (const std::exception&) {
    return damaged;
  }
  const torch::Tensor now = as_tensor(training);
  if (saved.size() != 6 || !saved[5].sizes().equals(now.sizes())) return damaged;
  if (const std::string other = difference(saved[5], now); !other.empty()) {
    return Error{file + ": was begun with other " + other +
                 "; delete it to train from the start, or train with the " + other + " as before"};
  }
  if (!network.restore({saved.begin(), saved.begin() + 4})) return damaged;
  const auto rows = saved[4].accessor<double, 2>();
  for (int64_t i = 0; i < rows.size(0); ++i) {
    losses.push_back({network.shape().name, static_cast<int64_t>(rows[i][0]),
                      static_cast<float>(rows[i][1]), static_cast<float>(rows[i][2])});
  }
  return {};
}

std::vector<std::string> find_checkpoints(const std::string& path) {
  std::vector<std::string> found;
  for (const char* network : {"pose", "timing", "contact"}) {
    std::error_code ignored;
    if (std::filesystem::exists(file_of(path, network), ignored)) {
      found.push_back(file_of(path, network));
    }
  }
  return found;
}

void remove_checkpoints(const std::string& path) {
  for (const std::string& file : find_checkpoints(path)) {
    std::error_code ignored;
    std::filesystem::remove(file, ignored);
  }
}

}  // namespace panache

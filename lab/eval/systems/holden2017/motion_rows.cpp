#include "eval/systems/holden2017/motion_rows.h"

#include <algorithm>

namespace panache::holden2017 {
namespace {

// Minimum scale of nearly constant rows: metres, m/s, radians/s and contacts alike.
constexpr float kMinScale = 0.05f;

torch::Tensor held_to(const torch::Tensor& rows, int64_t frames) {
  const int64_t missing = frames - rows.size(1);
  if (missing <= 0) return rows;
  return torch::cat({rows, rows.narrow(1, rows.size(1) - 1, 1).expand({kRows, missing})}, 1);
}

}  // namespace

torch::Tensor motion_rows(const Take& take) {
  torch::Tensor rows = torch::empty({take.frames(), kRows});
  float* out = rows.data_ptr<float>();
  for (int f = 0; f < take.frames(); ++f, out += kRows) {
    std::copy_n(&take.pose_features[size_t(f) * kPoseRows], kPoseRows, out);
    const FootContacts& planted = take.contacts[std::min<size_t>(f, take.contacts.size() - 1)];
    for (int foot = 0; foot < kFeet; ++foot) out[kPoseRows + foot] = planted[foot] ? 1.0f : 0.0f;
  }
  return rows.t().contiguous();
}

RowUnits::RowUnits(const std::vector<torch::Tensor>& motions) {
  const torch::Tensor all = torch::cat(motions, 1);
  mean_ = all.mean(1, true);
  scale_ = (all.var(1, false, true) + kMinScale * kMinScale).sqrt();
}

Windows::Windows(const std::vector<torch::Tensor>& motions) {
  int64_t end = 0;
  for (const torch::Tensor& motion : motions) {
    motions_.push_back(held_to(motion, kWindow));
    ends_.push_back(end += motions_.back().size(1) - kWindow + 1);
  }
}

torch::Tensor Windows::draw(int count, Random& random, std::vector<int>* which) const {
  std::vector<torch::Tensor> windows;
  if (which) which->clear();
  for (int i = 0; i < count; ++i) {
    const int64_t at = random.below(static_cast<uint32_t>(ends_.back()));
    const auto motion = std::upper_bound(ends_.begin(), ends_.end(), at) - ends_.begin();
    const int64_t first = at - (motion > 0 ? ends_[motion - 1] : 0);
    windows.push_back(motions_[motion].narrow(1, first, kWindow));
    if (which) which->push_back(static_cast<int>(motion));
  }
  return torch::stack(windows);
}

}  // namespace panache::holden2017

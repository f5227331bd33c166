#include "live_view.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <span>

#include "clip/bvh.h"

namespace panache::cli {
namespace {

constexpr std::chrono::milliseconds kPatience{500};  // Max wait for a pose.

}  // namespace

void LiveView::start(const Rig& rig, const Clip& first) {
  in_.emplace(rig, first.pose(0));
  styled_ = in_;
  std::string body = format_bvh(first);
  const std::scoped_lock lock(mutex_);
  body_ = std::move(body);
}

void LiveView::show(ConstPose in, ConstPose styled) {
  Parts parts;
  in_->read(in, std::span(parts).first<kMannequinNumbers>());
  styled_->read(styled, std::span(parts).last<kMannequinNumbers>());
  {
    const std::scoped_lock lock(mutex_);
    parts_ = parts;
    ++number_;
  }
  changed_.notify_all();
}

std::string LiveView::next(uint64_t& known) {
  Parts parts;
  {
    std::unique_lock lock(mutex_);
    if (!changed_.wait_for(lock, kPatience, [&] { return number_ != known; })) return "";
    known = number_;
    parts = parts_;
  }
  std::string out = "[";
  char text[32];
  for (const float number : parts) {
    std::snprintf(text, sizeof text, "%s%.5g", out.size() > 1 ? "," : "",
                  std::isfinite(number) ? static_cast<double>(number) : 0.0);
    out += text;
  }
  return out + "]";
}

std::string LiveView::body() {
  const std::scoped_lock lock(mutex_);
  return body_;
}

}  // namespace panache::cli

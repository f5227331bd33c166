#include "live_view.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <span>

#include "clip/bvh.h"

namespace panache::cli {
namespace {

constexpr std::chrono::milliseconds kPatience{500};  // For a pose.

void append(std::string& out, std::span<const float> numbers) {
  char text[32];
  for (const float number : numbers) {
    std::snprintf(text, sizeof text, "%s%.5g", out.size() > 1 ? "," : "",
                  std::isfinite(number) ? static_cast<double>(number) : 0.0);
    out += text;
  }
}

}  // namespace

void LiveView::start(const Rig& rig, const Clip& first) {
  in_.emplace(rig, first.pose(0));
  styled_ = in_;
  std::string body = format_bvh(first);
  const std::scoped_lock lock(mutex_);
  body_ = std::move(body);
}

void LiveView::show(ConstPose in, ConstPose styled) {
  Parts in_parts, styled_parts;
  in_->read(in, in_parts);
  styled_->read(styled, styled_parts);
  {
    const std::scoped_lock lock(mutex_);
    in_parts_ = in_parts;
    styled_parts_ = styled_parts;
    ++number_;
  }
  changed_.notify_all();
}

std::string LiveView::next(uint64_t& known) {
  Parts in, styled;
  {
    std::unique_lock lock(mutex_);
    if (!changed_.wait_for(lock, kPatience, [&] { return number_ != known; })) return "";
    known = number_;
    in = in_parts_;
    styled = styled_parts_;
  }
  std::string out = "[";
  append(out, in);
  append(out, styled);
  return out + "]";
}

std::string LiveView::body() {
  const std::scoped_lock lock(mutex_);
  return body_;
}

}  // namespace panache::cli

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <vector>

#include "clip/gltf_document.h"
#include "clip/gltf_encode.h"

namespace panache {
namespace {

// Maps time t of the file to t scale + shift.
struct Retiming {
  double scale = 1, shift = 0;
  bool changes() const { return scale != 1 || shift != 0; }
};

// "12.5" for messages.
std::string brief(double seconds) {
  std::string text = std::to_string(seconds);
  text.erase(text.find_last_not_of('0') + 1);
  return text.ends_with('.') ? text + "0" : text;
}

class Retimer {
 public:
  Retimer(const GltfDocument& document, GltfChecker& checker)
      : document_(document),
        checker_(checker),
        root_(document.container.json, unheard_),
        json_(document.container.json) {}

  bool retime(std::optional<double> fps, const std::string& name, RetimedGltf& out) {
    bool any = false;
    for (size_t a = 0; a < document_.animations.size(); ++a) {
      const GltfAnimation& animation = document_.animations[a];
      const double begin = begin_of(a);
      Retiming to;
      if (fps && animation.has_rate) to.scale = 1 / (*fps * animation.clip.frame_time);
      if (begin < 0) {
        to.shift = -begin * to.scale;
        out.notes.push_back(name + ": " + item_path("animations", a) +
                            ": expected no key before 0 s, found one at " + brief(begin) +
                            " s; all keys of this animation are read that much later");
      }
      const double twice = first_repeated(a);
      if (twice >= 0) {
        out.notes.push_back(name + ": " + item_path("animations", a) +
                            ": expected times that increase, found two keys at " + brief(twice) +
                            " s; the later of such keys is read as the next instant");
      }
      if (!to.changes() && twice < 0) continue;
      if (!retime_animation(a, to)) return false;
      any = true;
    }
    if (any) out.bytes = write_gltf_container(document_.container, std::move(json_), added_);
    return true;
  }

 private:
  // The accessor that a member of a sampler names; -1 if it cannot be read. Samplers that no
  // channel uses may hold anything.
  int accessor_of(const GltfPart& sampler, const char* member) const {
    return sampler.index(member, root_.size("accessors"));
  }
  bool read(int accessor, GltfValues& out) const {
    GltfChecker unread("");
    return accessor >= 0 && read_gltf_accessor(document_.container, accessor, "", unread, out);
  }
  bool read_times(int accessor, GltfValues& out) const {
    return read(accessor, out) && out.components == 1;
  }
  std::vector<GltfPart> samplers(size_t animation) const {
    return root_.item("animations", animation).list("samplers");
  }

  // The first time of any sampler, seconds; 0 where there are none.
  double begin_of(size_t animation) {
    double begin = INFINITY;
    for (const GltfPart& sampler : samplers(animation)) {
      const int accessor = accessor_of(sampler, "input");
      const auto [known, is_new] = begins_.try_emplace(accessor, INFINITY);
      GltfValues times;
      if (is_new && read_times(accessor, times)) known->second = times.numbers[0];
      begin = std::min(begin, known->second);
    }
    return std::isfinite(begin) ? begin : 0;
  }

  // The first time of a key that is not after the one before it, seconds; -1 if all times increase.
  double first_repeated(size_t animation) const {
    for (const GltfChannel& channel : document_.animations[animation].channels) {
      if (channel.path == GltfPath::other) continue;
      GltfValues times;
      const GltfPart sampler =
          root_.item("animations", animation).item("samplers", channel.sampler);
      if (!read_times(accessor_of(sampler, "input"), times)) continue;
      for (size_t i = 1; i < times.count; ++i) {
        if (!(times.numbers[i] > times.numbers[i - 1])) return std::max(0.0f, times.numbers[i]);
      }
    }
    return -1;
  }

  bool retime_animation(size_t animation, Retiming to) {
    const std::vector<GltfPart> list = samplers(animation);
    for (size_t s = 0; s < list.size(); ++s) {
      const int input = accessor_of(list[s], "input"), output = accessor_of(list[s], "output");
      GltfValues times;
      if (!read_times(input, times)) continue;
      GltfJson& changed = json_["animations"][animation]["samplers"][s];
      changed["input"] = times_at(input, times, to);
      if (to.scale != 1 && list[s].text("interpolation") == "CUBICSPLINE") {
        const int tangents = tangents_at(output, times.count, to.scale);
        if (tangents >= 0) changed["output"] = tangents;
      }
      const size_t max = gltf_max_values(document_.container.size);
      if (added_.size() / 4 <= max) continue;
      return checker_.fail(item_path("animations", animation),
                           "expected at most " + std::to_string(max) +
                               " numbers in keys of another time, found more");
    }
    return true;
  }

  // Each accessor has its own writer, so that times and values do not share a view.
  GltfDataWriter writer() {
    return GltfDataWriter(gltf_added_at(document_.container), json_, added_);
  }

  int times_at(int accessor, const GltfValues& old, Retiming to) {
    int& made = times_.emplace(std::tuple(accessor, to.scale, to.shift), -1).first->second;
    if (made >= 0) return made;
    std::vector<float> times;
    for (const float old_time : old.numbers) {
      const double exact = old_time * to.scale + to.shift;
      float time = static_cast<float>(std::max(0.0, exact));
      // Where floats are further apart than the keys, times must increase nevertheless.
      if (!times.empty()) time = std::max(time, std::nextafter(times.back(), HUGE_VALF));
      times.push_back(time);
    }
    return made = static_cast<int>(writer().add(times, "SCALAR", 1, true));
  }

  // The values of a cubic spline: its tangents are per second. -1 if there are none.
  int tangents_at(int accessor, size_t keys, double scale) {
    int& made = tangents_.emplace(std::pair(accessor, scale), -1).first->second;
    if (made >= 0) return made;
    GltfValues values;
    if (!read(accessor, values) || values.numbers.size() % (3 * keys) != 0) return -1;
    const size_t width = values.numbers.size() / (3 * keys);
    for (size_t i = 0; i < values.numbers.size(); ++i) {
      if (i / width % 3 == 1) continue;
      values.numbers[i] = static_cast<float>(values.numbers[i] / scale);
    }
    constexpr const char* kTypes[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
    return made = static_cast<int>(
               writer().add(values.numbers, kTypes[values.components - 1], values.components));
  }

  const GltfDocument& document_;
  GltfChecker& checker_;
  GltfChecker unheard_{""};
  GltfPart root_;
  GltfJson json_;
  std::string added_;
  std::map<int, double> begins_;                          // By accessor.
  std::map<std::tuple<int, double, double>, int> times_;  // Accessor, scale, shift.
  std::map<std::pair<int, double>, int> tangents_;        // Accessor, scale.
};

}  // namespace

bool retime_gltf(const GltfDocument& document, std::optional<double> fps, const std::string& name,
                 GltfChecker& checker, RetimedGltf& out) {
  return Retimer(document, checker).retime(fps, name, out);
}

}  // namespace panache

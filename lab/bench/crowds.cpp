// Crowds stepped through the C interface, as in a game.

#include <algorithm>
#include <new>
#include <utility>

#include <malloc.h>

#include "bench/steps.h"
#include "panache/panache.h"

namespace panache::bench {
namespace {

constexpr int kSizes[] = {1, 10, 100, 1000, 4000};
constexpr int kStride = 37;  // Offset between characters, frames.
// Small crowds are stepped repeatedly, for about this many character steps.
constexpr int kStepsPerRound = 1000;

// The model and skeleton shared by all characters.
class Shared {
 public:
  static Result<Shared> create(std::string_view bytes, const Clip& walk) {
    Shared shared;
    if (panache_model_create(bytes.data(), bytes.size(), &shared.model_) != PANACHE_OK) {
      return Error{panache_last_error()};
    }
    std::vector<panache_joint> joints;
    for (const Joint& joint : walk.skeleton.joints) {
      joints.push_back({joint.name.c_str(),
                        joint.parent,
                        {joint.rest.x, joint.rest.y, joint.rest.z, joint.rest.w},
                        {joint.offset.x, joint.offset.y, joint.offset.z}});
    }
    if (panache_skeleton_create(joints.data(), static_cast<int32_t>(joints.size()), nullptr,
                                &shared.skeleton_) != PANACHE_OK) {
      return Error{panache_last_error()};
    }
    return shared;
  }
  Shared(Shared&& other) noexcept
      : model_(std::exchange(other.model_, nullptr)),
        skeleton_(std::exchange(other.skeleton_, nullptr)) {}
  Shared& operator=(Shared&&) = delete;
  ~Shared() {
    panache_model_destroy(model_);
    panache_skeleton_destroy(skeleton_);
  }

  panache_character* make_character() const {
    panache_character* character = nullptr;
    if (panache_character_create(model_, skeleton_, nullptr, &character) != PANACHE_OK) {
      throw std::bad_alloc();  // The only possible failure.
    }
    panache_character_set_strength(character, 0, 1);
    return character;
  }

 private:
  Shared() = default;
  panache_model* model_ = nullptr;
  panache_skeleton* skeleton_ = nullptr;
};

class Crowd {
 public:
  Crowd(const Shared& shared, const Clip& walk, int size)
      : walk_(walk),
        in_(static_cast<size_t>(size)),
        rotations_(walk.joints() * in_.size()),
        translations_(walk.joints() * in_.size()) {
    for (size_t i = 0; i < in_.size(); ++i) {
      characters_.push_back(shared.make_character());
      const size_t first = i * walk.joints();
      out_.push_back({&rotations_[first].x, &translations_[first].x});
    }
  }
  ~Crowd() {
    for (panache_character* character : characters_) panache_character_destroy(character);
  }
  Crowd(const Crowd&) = delete;
  Crowd& operator=(const Crowd&) = delete;

  int size() const { return static_cast<int>(in_.size()); }
  // Steps all characters by one frame.
  void step() {
    for (size_t i = 0; i < in_.size(); ++i) {
      const int frame =
          static_cast<int>((frame_ + i * kStride) % static_cast<size_t>(walk_.frames));
      const ConstPose pose = walk_.pose(frame);
      in_[i] = {&pose.rotations.front().x, &pose.translations.front().x};
    }
    ++frame_;
    panache_step_many(characters_.data(), size(), in_.data(), walk_.frame_time, out_.data());
  }

 private:
  const Clip& walk_;
  size_t frame_ = 0;
  std::vector<panache_character*> characters_;
  std::vector<panache_input_pose> in_;
  std::vector<Quat> rotations_;  // [size][joints]
  std::vector<Vec3> translations_;
  std::vector<panache_output_pose> out_;
};

}  // namespace

Result<std::vector<CrowdTime>> time_crowds(std::string_view bytes, const Clip& walk, int rounds,
                                           const ProgressCall& progress) {
  const Result<Shared> shared = Shared::create(bytes, walk);
  if (!shared) return shared.error();
  std::vector<std::unique_ptr<Crowd>> crowds;
  for (const int size : kSizes) crowds.push_back(std::make_unique<Crowd>(*shared, walk, size));
  std::vector<std::vector<double>> times(crowds.size());
  for (int round = 0; round < rounds; ++round) {
    for (size_t c = 0; c < crowds.size(); ++c) {
      Crowd& crowd = *crowds[c];
      const int frames = std::max(1, kStepsPerRound / crowd.size());
      crowd.step();  // Untimed: the caches hold another crowd.
      // One frame of a large crowd takes longer than the time slice of other programs.
      const int64_t begin = computed_ns();
      for (int f = 0; f < frames; ++f) crowd.step();
      times[c].push_back(static_cast<double>(computed_ns() - begin) / frames / crowd.size());
    }
    if (progress) progress((round + 1.0) / rounds);
  }
  std::vector<CrowdTime> out;
  for (size_t c = 0; c < crowds.size(); ++c) {
    out.push_back({crowds[c]->size(), quantile(times[c], 0.5) / 1e3});
  }
  return out;
}

Result<double> bytes_per_character(std::string_view bytes, const Clip& walk) {
  constexpr int kCharacters = 1000;
  const Result<Shared> shared = Shared::create(bytes, walk);
  if (!shared) return shared.error();
  const auto in_use = [] {
    const struct mallinfo2 all = ::mallinfo2();
    return static_cast<double>(all.uordblks) + static_cast<double>(all.hblkhd);
  };
  std::vector<panache_character*> characters(kCharacters);
  const double before = in_use();
  for (panache_character*& character : characters) character = shared->make_character();
  const double taken = in_use() - before;
  for (panache_character* character : characters) panache_character_destroy(character);
  return taken / kCharacters;
}

}  // namespace panache::bench

// same_bits MODEL REMOVER POSES: writes the poses of a walking figure, styles them through the C
// interface and through the library as `panache stylize` does, and prints the hash of both. For the
// three.js sample, which styles the same poses, to compare its own with. Then the hashes of the
// poses, and of the whole clip, with one style taken off and another put on, and of the styles that
// the clip shows, for the npm package.

#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <vector>

#include "../../samples/common/stick_figure.h"
#include "rig/rig.h"
#include "style/restyle.h"

namespace {

constexpr int kFrames = 180;
constexpr double kFrameSeconds = 1.0 / 60;

class Hash {  // FNV-1a of the bits.
 public:
  void add(const float* numbers, size_t count) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(numbers);
    for (size_t i = 0; i < 4 * count; ++i) value_ = (value_ ^ bytes[i]) * 1099511628211u;
  }
  uint64_t value() const { return value_; }

 private:
  uint64_t value_ = 14695981039346656037u;
};

uint64_t hash_of(const float* rotations, const float* translations, int frames) {
  Hash hash;
  for (int f = 0; f < frames; ++f) {
    hash.add(rotations + 4 * STICK_JOINTS * f, 4 * STICK_JOINTS);
    hash.add(translations + 3 * STICK_JOINTS * f, 3 * STICK_JOINTS);
  }
  return hash.value();
}

uint64_t by_c_interface(const char* path, const std::vector<stick_pose>& poses) {
  panache_model* model = stick_load_model(path);
  panache_skeleton* skeleton = nullptr;
  panache_character* character = nullptr;
  if (panache_skeleton_create(stick_figure, STICK_JOINTS, nullptr, &skeleton) ||
      panache_character_create(model, skeleton, nullptr, &character)) {
    return 0;
  }
  panache_shape shape = PANACHE_SHAPE;
  shape.posture = 0.75f;
  shape.left_arm = 0.5f;
  panache_character_set_shape(character, &shape);
  panache_character_set_strength(character, panache_model_find_style(model, "old"), 0.5f);
  panache_character_set_strength(character, panache_model_find_style(model, "proud"), 0.75f);
  Hash hash;
  for (const stick_pose& in : poses) {
    stick_pose out;
    panache_character_step(character, stick_input(&in), kFrameSeconds, stick_output(&out));
    hash.add(out.rotations[0], 4 * STICK_JOINTS);
    hash.add(out.translations[0], 3 * STICK_JOINTS);
  }
  panache_character_destroy(character);
  panache_skeleton_destroy(skeleton);
  panache_model_destroy(model);
  return hash.value();
}

struct Removed {
  uint64_t poses = 0, clip = 0, shares = 0;
};

Removed remove_by_c_interface(const char* path, const char* remover_path,
                              const std::vector<stick_pose>& poses) {
  panache_model *model = stick_load_model(path), *remover = stick_load_model(remover_path);
  panache_skeleton* skeleton = nullptr;
  panache_character* character = nullptr;
  panache_character_options live = PANACHE_CHARACTER_OPTIONS;
  live.remover = remover;
  if (panache_skeleton_create(stick_figure, STICK_JOINTS, nullptr, &skeleton) ||
      panache_character_create(model, skeleton, &live, &character)) {
    return {};
  }
  const int32_t old = panache_model_find_style(remover, "old");
  const int32_t proud = panache_model_find_style(model, "proud");
  panache_character_set_removed(character, old);
  panache_character_set_strength(character, proud, 0.75f);
  std::vector<float> rotations, translations;
  Hash stepped;
  for (const stick_pose& in : poses) {
    stick_pose out;
    panache_character_step(character, stick_input(&in), kFrameSeconds, stick_output(&out));
    stepped.add(out.rotations[0], 4 * STICK_JOINTS);
    stepped.add(out.translations[0], 3 * STICK_JOINTS);
    rotations.insert(rotations.end(), in.rotations[0], in.rotations[STICK_JOINTS]);
    translations.insert(translations.end(), in.translations[0], in.translations[STICK_JOINTS]);
  }
  const panache_clip clip = {skeleton, kFrames, kFrameSeconds, rotations.data(),
                             translations.data()};
  const panache_strength_key key = {0, 0.75f};
  const panache_strength_track track = {proud, 1, &key};
  panache_stylize_options whole = PANACHE_STYLIZE_OPTIONS;
  whole.remover = remover;
  whole.removed = old;
  panache_styled_clip* styled = nullptr;
  std::vector<float> shares(static_cast<size_t>(panache_model_style_count(remover)) + 1);
  const auto count = static_cast<int32_t>(shares.size());
  if (panache_stylize_clip(model, &clip, &track, 1, &whole, &styled) ||
      panache_recognise_styles(remover, &clip, shares.data(), count)) {
    return {};
  }
  Hash told;
  told.add(shares.data(), shares.size());
  const Removed hashes = {
      stepped.value(),
      hash_of(panache_styled_clip_rotations(styled), panache_styled_clip_translations(styled),
              panache_styled_clip_frame_count(styled)),
      told.value()};
  panache_styled_clip_destroy(styled);
  panache_character_destroy(character);
  panache_skeleton_destroy(skeleton);
  panache_model_destroy(remover);
  panache_model_destroy(model);
  return hashes;
}

// As the program does, tempo apart; its own output passes through the decimals of a file.
uint64_t by_library(const char* path, const std::vector<stick_pose>& poses) {
  using namespace panache;
  Clip clip;
  for (const panache_joint& joint : stick_figure) {
    Joint own;
    own.name = joint.name;
    own.parent = joint.parent;
    own.rest = {joint.rotation[0], joint.rotation[1], joint.rotation[2], joint.rotation[3]};
    own.offset = {joint.translation[0], joint.translation[1], joint.translation[2]};
    own.can_rotate = own.can_translate = true;
    clip.skeleton.joints.push_back(own);
  }
  clip.frame_time = kFrameSeconds;
  clip.resize(1);
  for (size_t j = 0; j < clip.joints(); ++j) {
    clip.rotations[j] = clip.skeleton.joints[j].rest;
    clip.translations[j] = clip.skeleton.joints[j].offset;
  }
  const Result<Rig> rig = Rig::create(clip);
  const auto model = Model::load(path);
  if (!rig || !model) return 0;
  clip.resize(kFrames);
  for (int f = 0; f < kFrames; ++f) {
    const Pose pose = clip.pose(f);
    std::memcpy(pose.rotations.data(), poses[f].rotations, sizeof poses[f].rotations);
    std::memcpy(pose.translations.data(), poses[f].translations, sizeof poses[f].translations);
  }
  RestyleOptions options;
  options.timing = false;
  options.stylizer.shape.posture = 0.75f;
  options.stylizer.shape.regions[static_cast<size_t>(Region::left_arm)] = 0.5f;
  const auto track = [&](const char* style, float strength) {
    return StrengthTrack{*(*model)->find_style(style), {{0, strength}}};
  };
  const Result<Restyled> styled =
      restyle(clip, *rig, *model, {track("old", 0.5f), track("proud", 0.75f)}, options);
  if (!styled) return 0;
  return hash_of(&styled->clip.rotations[0].x, &styled->clip.translations[0].x,
                 styled->clip.frames);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return std::fputs("usage: same_bits MODEL REMOVER POSES\n", stderr), 2;
  std::vector<stick_pose> poses(kFrames);
  for (int f = 0; f < kFrames; ++f) stick_walk(f * kFrameSeconds, 0, &poses[f]);
  FILE* file = std::fopen(argv[3], "wb");
  if (!file || std::fwrite(poses.data(), sizeof poses[0], poses.size(), file) != poses.size() ||
      std::fclose(file)) {
    return std::fprintf(stderr, "%s: cannot be written\n", argv[3]), 1;
  }
  const Removed removed = remove_by_c_interface(argv[1], argv[2], poses);
  for (const uint64_t hash : {by_c_interface(argv[1], poses), by_library(argv[1], poses),
                              removed.poses, removed.clip, removed.shares}) {
    std::printf("%016" PRIx64 "\n", hash);
  }
}

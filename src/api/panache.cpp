// The C interface: checks what comes in, and hands it on.
#include "panache/panache.h"

#include <array>
#include <cmath>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "learn/learn_style.h"
#include "learn/style_file.h"
#include "rig/calibration.h"
#include "rig/rig.h"
#include "style/crowd.h"
#include "style/live_stylizer.h"
#include "style/model.h"

struct panache_model {
  std::shared_ptr<const panache::Model> model;
};
struct panache_skeleton {
  panache::Rig rig;
  panache::Skeleton joints;
};
struct panache_learnt {
  std::string model;
  panache::LearntStyle style;
  std::string warnings;
};
struct panache_character {
  panache::LiveStylizer live;
  std::vector<float> strengths;  // As set.
};

namespace {

using namespace panache;

static_assert(sizeof(Quat) == 4 * sizeof(float) && sizeof(Vec3) == 3 * sizeof(float));

constexpr int32_t kMaxJoints = 10'000, kMaxPoses = 10'000, kMaxFrames = 1'000'000;

// Kept per thread: the message that was made last, and the one to show, which is that or a fixed
// one that needs no memory.
thread_local std::string made_error;
thread_local const char* last_error = "";

panache_status fail(panache_status status, const std::string& message) {
  made_error = message;
  last_error = made_error.c_str();
  return status;
}

// Runs `work`, which may allocate; C knows no exceptions.
template <class Work>
panache_status guarded(Work&& work) noexcept {
  try {
    return work();
  } catch (...) {  // std::bad_alloc, or what containers throw for sizes beyond any memory.
    last_error = "out of memory";
    return PANACHE_NO_MEMORY;
  }
}

template <class T>
void start(T** out) {
  *out = nullptr;
}

Quat quat(const float* q) { return {q[0], q[1], q[2], q[3]}; }
Vec3 vec(const float* v) { return {v[0], v[1], v[2]}; }

// A rotation that is nearly of unit length, made so; nothing where it is not.
bool make_unit(Quat& q) {
  const float square = dot(q, q);
  if (!is_finite(q) || std::abs(square - 1) > 0.1f) return false;
  q = normalized(q);
  return true;
}

Result<Skeleton> read_skeleton(const panache_joint* joints, int32_t count) {
  if (count < 1 || count > kMaxJoints) {
    return Error{std::to_string(count) + " joints; expected 1 to " + std::to_string(kMaxJoints)};
  }
  Skeleton out;
  for (int32_t j = 0; j < count; ++j) {
    Joint joint;
    joint.name = joints[j].name ? joints[j].name : "";
    joint.parent = joints[j].parent;
    joint.rest = quat(joints[j].rotation);
    joint.offset = vec(joints[j].translation);
    joint.can_rotate = joint.can_translate = true;
    const std::string place = "joint " + std::to_string(j) + " '" + joint.name + "': ";
    if (joint.parent < -1 || joint.parent >= j) {
      return Error{place + "parent is " + std::to_string(joint.parent) +
                   "; expected a joint before it, or -1"};
    }
    if (!make_unit(joint.rest)) {
      return Error{place + "its rest rotation is no unit quaternion (x, y, z, w)"};
    }
    if (!is_finite(joint.offset)) return Error{place + "its rest translation is not finite"};
    out.joints.push_back(std::move(joint));
  }
  return out;
}

// The frames of `clip`, [frames][joints]: of each a rotation and a translation.
Result<void> read_frames(const float* rotations, const float* translations, int32_t count,
                         Clip& clip) {
  if (count > 0 && (!rotations || !translations)) {
    return Error{"poses need both rotations and translations"};
  }
  const size_t joints = clip.skeleton.joints.size();
  for (size_t i = 0; i < static_cast<size_t>(count) * joints; ++i) {
    Quat q = quat(rotations + 4 * i);
    const Vec3 v = vec(translations + 3 * i);
    const std::string place =
        "pose " + std::to_string(i / joints) + ", joint " + std::to_string(i % joints) + ": ";
    if (!make_unit(q)) {
      return Error{place + "its rotation is no unit quaternion (x, y, z, w)"};
    }
    if (!is_finite(v)) return Error{place + "its translation is not finite"};
    clip.rotations.push_back(q);
    clip.translations.push_back(v);
  }
  clip.frames = count;
  return {};
}

Result<Clip> read_poses(Skeleton skeleton, const panache_skeleton_options& options) {
  Clip clip{std::move(skeleton), 1.0 / 30, 0, {}, {}};
  const int32_t count = options.pose_count;
  if (count < 0 || count > kMaxPoses) {
    return Error{std::to_string(count) + " poses; expected 0 to " + std::to_string(kMaxPoses)};
  }
  auto read = read_frames(options.rotations, options.translations, count, clip);
  if (!read) return read.error();
  if (count == 0) {
    for (const Joint& joint : clip.skeleton.joints) {
      clip.rotations.push_back(joint.rest);
      clip.translations.push_back(joint.offset);
    }
    clip.frames = 1;
  }
  return clip;
}

Result<Clip> read_clip(const panache_clip& from, const std::string& name) {
  if (from.frame_count < 0 || from.frame_count > kMaxFrames) {
    return Error{name + ": has " + std::to_string(from.frame_count) + " frames; expected up to " +
                 std::to_string(kMaxFrames)};
  }
  if (!(from.frame_seconds > 0 && from.frame_seconds <= 1)) {
    return Error{name + ": has frames " + std::to_string(from.frame_seconds) +
                 " seconds apart; expected more than 0 and at most 1"};
  }
  Clip clip{from.skeleton->joints, from.frame_seconds, 0, {}, {}};
  auto read = read_frames(from.rotations, from.translations, from.frame_count, clip);
  if (!read) return Error{name + ": " + read.error().message};
  return clip;
}

Result<LearnPair> read_pair(const panache_pair& pair, int32_t number) {
  const std::string name = "pair " + std::to_string(number);
  const std::string neutral_name = name + ", neutral", styled_name = name + ", styled";
  Result<Clip> neutral = read_clip(pair.neutral, neutral_name);
  if (!neutral) return neutral.error();
  Result<Clip> styled = read_clip(pair.styled, styled_name);
  if (!styled) return styled.error();
  return make_learn_pair({*neutral, pair.neutral.skeleton->rig, neutral_name},
                         {*styled, pair.styled.skeleton->rig, styled_name});
}

ConstPose view(const panache_input_pose& pose, size_t joints) {
  return {{reinterpret_cast<const Quat*>(pose.rotations), joints},
          {reinterpret_cast<const Vec3*>(pose.translations), joints}};
}
Pose view(const panache_output_pose& pose, size_t joints) {
  return {{reinterpret_cast<Quat*>(pose.rotations), joints},
          {reinterpret_cast<Vec3*>(pose.translations), joints}};
}

}  // namespace

int32_t panache_version(void) {
  return 10000 * PANACHE_VERSION_MAJOR + 100 * PANACHE_VERSION_MINOR + PANACHE_VERSION_PATCH;
}

const char* panache_last_error(void) { return last_error; }

panache_status panache_model_create(const void* bytes, size_t size, panache_model** out) {
  start(out);
  return guarded([&] {
    auto model = Model::parse({static_cast<const char*>(bytes), size}, "model");
    if (!model) return fail(PANACHE_BAD_MODEL, model.error().message);
    *out = new panache_model{*std::move(model)};
    return PANACHE_OK;
  });
}

void panache_model_destroy(panache_model* model) { delete model; }

int32_t panache_model_style_count(const panache_model* model) {
  return static_cast<int32_t>(model->model->styles().size());
}

const char* panache_model_style_name(const panache_model* model, int32_t style) {
  if (style < 0 || style >= panache_model_style_count(model)) return nullptr;
  return model->model->styles()[static_cast<size_t>(style)].name.c_str();
}

int32_t panache_model_find_style(const panache_model* model, const char* name) {
  for (int32_t i = 0; i < panache_model_style_count(model); ++i) {
    if (model->model->styles()[static_cast<size_t>(i)].name == name) return i;
  }
  return -1;
}

panache_status panache_skeleton_create(const panache_joint* joints, int32_t joint_count,
                                       const panache_skeleton_options* options,
                                       panache_skeleton** out) {
  start(out);
  return guarded([&] {
    const panache_skeleton_options given = options ? *options : panache_skeleton_options{};
    Result<Skeleton> skeleton = read_skeleton(joints, joint_count);
    if (!skeleton) return fail(PANACHE_BAD_SKELETON, skeleton.error().message);
    Result<Clip> clip = read_poses(*std::move(skeleton), given);
    if (!clip) return fail(PANACHE_BAD_ARGUMENT, clip.error().message);
    RigOptions how;
    if (given.metres_per_unit != 0) how.metres_per_unit = given.metres_per_unit;
    if (given.up_axis) how.up_axis = given.up_axis;
    if (auto good = check_units(how.metres_per_unit, how.up_axis); !good) {
      return fail(PANACHE_BAD_ARGUMENT, good.error().message);
    }
    Result<Rig> rig = Rig::create(*clip, how);
    if (!rig) return fail(PANACHE_BAD_SKELETON, rig.error().message);
    *out = new panache_skeleton{*std::move(rig), std::move(clip->skeleton)};
    return PANACHE_OK;
  });
}

void panache_skeleton_destroy(panache_skeleton* skeleton) { delete skeleton; }

int32_t panache_skeleton_joint_count(const panache_skeleton* skeleton) {
  return static_cast<int32_t>(skeleton->rig.joint_count());
}

int32_t panache_skeleton_find(const panache_skeleton* skeleton, const char* vrm_name) {
  const std::optional<int> joint = find_human_joint(vrm_name);
  return joint ? skeleton->rig.joints()[static_cast<size_t>(*joint)] : -1;
}

panache_status panache_character_create(const panache_model* model,
                                        const panache_skeleton* skeleton,
                                        const panache_character_options* options,
                                        panache_character** out) {
  start(out);
  return guarded([&] {
    LiveOptions how;
    if (options) {
      how.stylizer.ease_seconds = options->ease_seconds;
      how.stylizer.smoothing_seconds = options->smoothing_seconds;
      how.stylizer.foot_lock = options->hold_feet != 0;
      how.stylizer.root = options->style_root != 0;
      how.max_lag = options->max_lag;
      how.max_lead = options->max_lead;
      how.skip_cycles = options->skip_cycles != 0;
    }
    Result<LiveStylizer> live = LiveStylizer::create(model->model, skeleton->rig, how);
    if (!live) return fail(PANACHE_BAD_ARGUMENT, live.error().message);
    *out =
        new panache_character{*std::move(live), std::vector<float>(model->model->styles().size())};
    return PANACHE_OK;
  });
}

void panache_character_destroy(panache_character* character) { delete character; }

void panache_character_set_strength(panache_character* character, int32_t style, float strength) {
  const auto place = static_cast<size_t>(style);
  if (style < 0 || place >= character->strengths.size() || !std::isfinite(strength)) return;
  character->strengths[place] = strength;
}

void panache_character_step(panache_character* character, panache_input_pose in, double seconds,
                            panache_output_pose out) {
  const size_t joints = character->live.stylizer().rig().joint_count();
  character->live.step(view(in, joints), character->strengths, seconds, view(out, joints));
}

void panache_step_many(panache_character* const* characters, int32_t count,
                       const panache_input_pose* in, double seconds,
                       const panache_output_pose* out) {
  // As many at a time as have a place on the stack.
  std::array<CrowdMember, 64> members;
  int32_t done = 0;
  while (done < count) {
    size_t taken = 0;
    for (; taken < members.size() && done < count; ++taken, ++done) {
      panache_character& character = *characters[done];
      // Who has a time of his own goes alone.
      if (!character.live.is_pass_through()) break;
      Stylizer& stylizer = character.live.stylizer();
      const size_t joints = stylizer.rig().joint_count();
      members[taken] = {&stylizer, view(in[done], joints), character.strengths,
                        view(out[done], joints)};
    }
    step_crowd(std::span(members).first(taken), seconds);
    for (; done < count && !characters[done]->live.is_pass_through(); ++done) {
      panache_character_step(characters[done], in[done], seconds, out[done]);
    }
  }
}

void panache_character_reset(panache_character* character) { character->live.reset(); }

panache_report panache_character_report(const panache_character* character) {
  const Stylizer& stylizer = character->live.stylizer();
  const std::span<const float> contacts = stylizer.contacts();
  return {stylizer.rate(), character->live.ahead(), stylizer.gate(), {contacts[0], contacts[1]}};
}

size_t panache_character_state_size(const panache_character* character) {
  return character->live.state_size();
}

void panache_character_save(const panache_character* character, void* out) {
  const size_t size = character->live.state_size();
  character->live.save({static_cast<std::byte*>(out), size});
}

panache_status panache_character_restore(panache_character* character, const void* bytes,
                                         size_t size) {
  if (character->live.restore({static_cast<const std::byte*>(bytes), size})) return PANACHE_OK;
  return guarded([&] {
    return fail(PANACHE_BAD_STATE, "expected the " + std::to_string(character->live.state_size()) +
                                       " bytes of a state saved by a character of the same model, "
                                       "skeleton and options; found " +
                                       std::to_string(size) + " bytes that are none");
  });
}

panache_status panache_learn(const void* model_bytes, size_t model_size, const panache_pair* pairs,
                             int32_t pair_count, const char* name, int32_t replace,
                             panache_learnt** out) {
  start(out);
  return guarded([&] {
    const std::string_view bytes(static_cast<const char*>(model_bytes), model_size);
    Result<TensorFile> model = parse_safetensors(bytes, "the model");
    if (!model) return fail(PANACHE_BAD_MODEL, model.error().message);
    const auto read = Model::create(*model, "the model");
    if (!read) return fail(PANACHE_BAD_MODEL, read.error().message);
    if (!(*read)->can_learn()) {
      return fail(PANACHE_BAD_MODEL, cannot_learn("the model").message);
    }
    if (!replace && (*read)->find_style(name)) {
      return fail(PANACHE_BAD_ARGUMENT, std::string("the model has a style '") + name +
                                            "' already; give another name, or replace it");
    }
    if (auto good = check_style_name(name); !good) {
      return fail(PANACHE_BAD_ARGUMENT, good.error().message);
    }
    std::vector<LearnPair> learnt_from;
    for (int32_t p = 0; p < pair_count; ++p) {
      Result<LearnPair> pair = read_pair(pairs[p], p + 1);
      if (!pair) return fail(PANACHE_BAD_CLIP, pair.error().message);
      learnt_from.push_back(*std::move(pair));
    }
    Result<LearntStyle> style = learn_style(*model, "the model", learnt_from, name, "");
    if (!style) return fail(PANACHE_BAD_CLIP, style.error().message);
    Result<TensorFile> merged = add_style(*model, "the model", style->file, name, true);
    if (!merged) return fail(PANACHE_BAD_MODEL, merged.error().message);
    std::string warnings;
    for (const PairReport& pair : style->pairs) {
      for (const std::string& warning : pair.warnings) warnings += warning + "\n";
    }
    *out = new panache_learnt{format_safetensors(*merged), *std::move(style), std::move(warnings)};
    return PANACHE_OK;
  });
}

void panache_learnt_destroy(panache_learnt* learnt) { delete learnt; }

const void* panache_learnt_model(const panache_learnt* learnt, size_t* size) {
  *size = learnt->model.size();
  return learnt->model.data();
}

panache_learnt_report panache_learnt_get_report(const panache_learnt* learnt) {
  const LearntStyle& style = learnt->style;
  return {style.held_back_cm, style.mean_posture_cm, style.untouched_cm, learnt->warnings.c_str()};
}

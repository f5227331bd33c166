#include "clip/smpl.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "clip/npy.h"

namespace panache {
namespace {

constexpr size_t kMaxPoses = 50'000'000;  // Joints times frames.
constexpr double kMinRate = 1e-3, kMaxRate = 1e6;
// Arrays that hold the frames per second, in order of preference: those of AMASS first.
constexpr const char* kRateNames[] = {"mocap_framerate", "mocap_frame_rate", "fps", "framerate",
                                      "frame_rate"};
bool is_rate(const std::string& array) {
  return std::find(std::begin(kRateNames), std::end(kRateNames), array) != std::end(kRateNames);
}

// Names of arrays that repeat some of the columns of `poses`, for each model.
struct Part {
  const char* name;
  size_t joints;  // Of the model.
  size_t first, last;
};
constexpr Part kParts[] = {
    {"root_orient", kSmplJoints, 0, 1},  {"pose_body", kSmplJoints, 1, 24},
    {"root_orient", kSmplHJoints, 0, 1}, {"pose_body", kSmplHJoints, 1, 22},
    {"pose_hand", kSmplHJoints, 22, 52}, {"root_orient", kSmplXJoints, 0, 1},
    {"pose_body", kSmplXJoints, 1, 22},  {"pose_jaw", kSmplXJoints, 22, 23},
    {"pose_eye", kSmplXJoints, 23, 25},  {"pose_hand", kSmplXJoints, 25, 55},
};

std::string array_name(const NpzMember& member) {
  const bool npy = member.name.ends_with(".npy");
  return member.name.substr(0, member.name.size() - (npy ? 4 : 0));
}

// Frames per second; some programs truncate the rate, so 59.999999 must become 60.
double rate_of(const Clip& clip) {
  const double rate = 1 / clip.frame_time;
  return std::abs(rate - std::round(rate)) < 1e-4 ? std::round(rate) : rate;
}

// An array of numbers, [rows][columns].
struct Table {
  std::string type;
  std::vector<size_t> shape;
  std::vector<double> numbers;
};

class SmplFile final : public MotionFile {
 public:
  SmplFile(std::vector<NpzMember> members, std::string whole, PackNpz pack)
      : members_(std::move(members)), whole_(std::move(whole)), pack_(pack) {}

  Result<void> read(const std::string& name, const ReadOptions& options) {
    if (options.fps) set_rate(*options.fps);
    Result<Table> poses = table("poses", name), trans = table("trans", name);
    if (!poses) return poses.error();
    if (!trans) return trans.error();
    poses_ = *std::move(poses);
    trans_ = *std::move(trans);
    const size_t columns = poses_.shape.size() == 2 ? poses_.shape[1] : 0;
    const size_t joints = columns / 3;
    if (columns % 3 != 0 ||
        (joints != kSmplJoints && joints != kSmplHJoints && joints != kSmplXJoints)) {
      return Error{name + ": poses: expected frames of 72 (SMPL), 156 (SMPL-H) or 165 (SMPL-X) " +
                   "numbers, found " + shape_of(poses_)};
    }
    const size_t frames = poses_.shape[0];
    if (frames == 0 || frames > kMaxPoses / joints) {
      return Error{name + ": poses: expected 1 to " + std::to_string(kMaxPoses / joints) +
                   " frames, found " + std::to_string(frames)};
    }
    if (trans_.shape != std::vector<size_t>{frames, 3}) {
      return Error{name + ": trans: expected (" + std::to_string(frames) +
                   ", 3), as many frames as poses has, found " + shape_of(trans_)};
    }
    if (auto rate = read_rate(name); !rate) return rate;
    clip_.skeleton = smpl_skeleton(joints);
    clip_.resize(static_cast<int>(frames));
    for (int f = 0; f < clip_.frames; ++f) fill(f);
    return {};
  }

  std::vector<std::string> clip_names() const override { return {""}; }
  const Clip& clip(int) const override { return clip_; }
  Clip rest() const override { return rest_clip(clip_.skeleton); }

  std::string encode(std::span<const ClipEdit> edits, EditMode) const override {
    if (edits.empty()) return whole_;
    assert(edits.size() == 1);
    const ClipEdit& edit = edits.front();
    const Clip& changed = *edit.changed;
    const bool is_new = edit.clip == kNewClip;
    if (!is_new && is_same(edit)) return whole_;
    const Table poses = new_poses(edit), trans = new_trans(edit);
    std::vector<NpzMember> out;
    for (const NpzMember& member : members_) {
      const std::string name = array_name(member);
      if (name == "poses" || name == "trans") {
        out.push_back({member.name, to_npy(name == "poses" ? poses : trans)});
      } else if (const std::optional<Table> part = part_of(poses, name)) {
        out.push_back({member.name, to_npy(*part)});
      } else if (is_new && is_rate(name)) {
        out.push_back({member.name, rate_bytes(rate_of(changed))});
      } else if (!has_row_per_frame(member)) {
        out.push_back(member);
      }
    }
    return pack_(out);
  }

 private:
  static std::string shape_of(const Table& table) {
    std::string text = "(";
    for (size_t i = 0; i < table.shape.size(); ++i) {
      text += (i ? ", " : "") + std::to_string(table.shape[i]);
    }
    return text + ")";
  }
  static std::string to_npy(const Table& table) {
    return format_npy(npy_array(table.numbers, table.shape, table.type));
  }

  const NpzMember* find(const std::string& array) const {
    for (const NpzMember& member : members_) {
      if (array_name(member) == array) return &member;
    }
    return nullptr;
  }

  Result<Table> table(const std::string& array, const std::string& name) const {
    const NpzMember* member = find(array);
    if (!member) {
      std::string names;
      for (size_t i = 0; i < std::min<size_t>(members_.size(), 12); ++i) {
        names += (i ? ", " : "") + array_name(members_[i]).substr(0, 40);
      }
      return Error{name + ": expected an array " + array + ", as in AMASS, found " +
                   (names.empty() ? "none" : names)};
    }
    const std::string where = name + ": " + array;
    Result<NpyArray> read = parse_npy(member->bytes, where);
    if (!read) return read.error();
    if (read->count() > 3 * kMaxPoses) {
      return Error{where + ": expected at most " + std::to_string(3 * kMaxPoses) +
                   " numbers, found " + std::to_string(read->count())};
    }
    Result<std::vector<double>> numbers = npy_numbers(*read, where);
    if (!numbers) return numbers.error();
    return Table{read->type, read->shape, *std::move(numbers)};
  }

  static std::string rate_bytes(double rate) {
    return format_npy(npy_array({&rate, 1}, {}, "<f8"));
  }

  // Sets the rate in the archive.
  void set_rate(double rate) {
    bool has_rate = false;
    for (NpzMember& member : members_) {
      if (!is_rate(array_name(member))) continue;
      member.bytes = rate_bytes(rate);
      has_rate = true;
    }
    if (!has_rate) members_.push_back({std::string(kRateNames[0]) + ".npy", rate_bytes(rate)});
    whole_ = pack_(members_);
  }

  Result<void> read_rate(const std::string& name) {
    const auto known = std::find_if(std::begin(kRateNames), std::end(kRateNames),
                                    [&](const char* array) { return find(array); });
    const std::string array = known == std::end(kRateNames) ? kRateNames[0] : *known;
    Result<Table> rate = table(array, name);
    if (!rate) return Error{rate.error().message + "; " + kGiveRate, ErrorKind::rate_needed};
    if (rate->numbers.size() != 1 ||
        !(rate->numbers[0] >= kMinRate && rate->numbers[0] <= kMaxRate)) {
      return Error{
          name + ": " + array + ": expected a number of frames per second above 0, found " +
              (rate->numbers.size() == 1 ? std::to_string(rate->numbers[0])
                                         : std::to_string(rate->numbers.size()) + " numbers") +
              "; " + kGiveRate,
          ErrorKind::rate_needed};
    }
    clip_.frame_time = 1 / rate->numbers[0];
    return {};
  }

  void fill(int frame) {
    const Pose pose = clip_.pose(frame);
    const size_t joints = clip_.joints();
    for (size_t j = 0; j < joints; ++j) {
      const double* v = &poses_.numbers[(frame * joints + j) * 3];
      pose.rotations[j] = normalized(exp_rotation(Vec3d{v[0], v[1], v[2]})).as<float>();
      pose.translations[j] = clip_.skeleton.joints[j].offset;
    }
    const double* t = &trans_.numbers[size_t(frame) * 3];
    // A model rotates about its pelvis, then translates.
    pose.translations[0] = (pelvis() + Vec3d{t[0], t[1], t[2]}).as<float>();
  }
  Vec3d pelvis() const { return clip_.skeleton.joints[0].offset.as<double>(); }

  // The file's frame that an edit's frame came from; -1 if it is from none, or between two.
  int source(const ClipEdit& edit, int frame) const {
    if (edit.clip == kNewClip) return -1;
    const double at = edit.source_frames[frame];
    const bool whole = at >= 0 && at < clip_.frames && at == std::floor(at);
    return whole ? static_cast<int>(at) : -1;
  }

  bool is_same(const ClipEdit& edit) const {
    if (edit.changed->frames != clip_.frames) return false;
    for (int f = 0; f < clip_.frames; ++f) {
      if (source(edit, f) != f) return false;
      for (size_t j = 0; j < clip_.joints(); ++j) {
        if (!(edit.changed->pose(f).rotations[j] == clip_.pose(f).rotations[j])) return false;
      }
      if (edit.changed->pose(f).translations[0] != clip_.pose(f).translations[0]) return false;
    }
    return true;
  }

  Table new_poses(const ClipEdit& edit) const {
    const Clip& changed = *edit.changed;
    const size_t joints = clip_.joints();
    Table out{poses_.type, {size_t(changed.frames), joints * 3}, {}};
    for (int f = 0; f < changed.frames; ++f) {
      const int from = source(edit, f);
      for (size_t j = 0; j < joints; ++j) {
        const Quat q = changed.pose(f).rotations[j];
        const double* old = from < 0 ? nullptr : &poses_.numbers[(from * joints + j) * 3];
        if (old && clip_.pose(from).rotations[j] == q) {
          out.numbers.insert(out.numbers.end(), old, old + 3);
        } else {
          const Vec3d v = log_rotation(normalized(q.as<double>()));
          out.numbers.insert(out.numbers.end(), {v.x, v.y, v.z});
        }
      }
    }
    return out;
  }

  Table new_trans(const ClipEdit& edit) const {
    const Clip& changed = *edit.changed;
    Table out{trans_.type, {size_t(changed.frames), 3}, {}};
    for (int f = 0; f < changed.frames; ++f) {
      const int from = source(edit, f);
      const Vec3 translation = changed.pose(f).translations[0];
      const double* old = from < 0 ? nullptr : &trans_.numbers[size_t(from) * 3];
      if (old && clip_.pose(from).translations[0] == translation) {
        out.numbers.insert(out.numbers.end(), old, old + 3);
      } else {
        const Vec3d t = translation.as<double>() - pelvis();
        out.numbers.insert(out.numbers.end(), {t.x, t.y, t.z});
      }
    }
    return out;
  }

  // The columns of the poses that an array repeats; nothing for other arrays.
  std::optional<Table> part_of(const Table& poses, const std::string& name) const {
    for (const Part& part : kParts) {
      if (part.joints != clip_.joints() || name != part.name) continue;
      const size_t width = (part.last - part.first) * 3, rows = poses.shape[0];
      Table out{poses.type, {rows, width}, {}};
      for (size_t r = 0; r < rows; ++r) {
        const auto row = poses.numbers.begin() + r * poses.shape[1];
        out.numbers.insert(out.numbers.end(), row + part.first * 3, row + part.last * 3);
      }
      return out;
    }
    return std::nullopt;
  }

  bool has_row_per_frame(const NpzMember& member) const {
    const Result<NpyArray> array = parse_npy(member.bytes, "");
    // With a single frame, everything would seem to have a row per frame.
    return array && array->shape.size() > 1 && array->shape[0] == poses_.shape[0];
  }

  std::vector<NpzMember> members_;
  std::string whole_;
  PackNpz pack_;
  Table poses_, trans_;
  Clip clip_;
};

}  // namespace

Result<std::unique_ptr<MotionFile>> parse_smpl(std::vector<NpzMember> members, std::string whole,
                                               PackNpz pack, const std::string& name,
                                               const ReadOptions& options) {
  auto file = std::make_unique<SmplFile>(std::move(members), std::move(whole), pack);
  if (auto done = file->read(name, options); !done) return done.error();
  return std::unique_ptr<MotionFile>(std::move(file));
}

Clip smpl_body() { return rest_clip(smpl_skeleton(kSmplHJoints)); }

std::vector<NpzMember> format_smpl(const Clip& clip) {
  assert(clip.joints() == kSmplHJoints);
  const Quatd z_up = axis_angle(Vec3d{1, 0, 0}, std::acos(0.0));
  const Vec3d pelvis = clip.skeleton.joints[0].offset.as<double>();
  const size_t frames = clip.frames;
  std::vector<double> poses, trans;
  for (int f = 0; f < clip.frames; ++f) {
    const ConstPose pose = clip.pose(f);
    for (size_t j = 0; j < clip.joints(); ++j) {
      const Quatd q = pose.rotations[j].as<double>();
      const Vec3d v = log_rotation(normalized(j == 0 ? z_up * q : q));
      poses.insert(poses.end(), {v.x, v.y, v.z});
    }
    const Vec3d t = rotate(z_up, pose.translations[0].as<double>()) - pelvis;
    trans.insert(trans.end(), {t.x, t.y, t.z});
  }
  const double rate = rate_of(clip);
  const std::vector<double> betas(16);
  std::string gender;  // Numpy's Unicode text has four bytes per character.
  for (const char c : std::string("neutral")) gender += {c, '\0', '\0', '\0'};
  return {{"trans.npy", format_npy(npy_array(trans, {frames, 3}, "<f8"))},
          {"gender.npy", format_npy({"<U7", false, {}, gender})},
          {"mocap_framerate.npy", format_npy(npy_array({&rate, 1}, {}, "<f8"))},
          {"betas.npy", format_npy(npy_array(betas, {betas.size()}, "<f8"))},
          {"poses.npy", format_npy(npy_array(poses, {frames, clip.joints() * 3}, "<f8"))}};
}

}  // namespace panache

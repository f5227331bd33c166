#include "clip/acclaim.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <utility>
#include <vector>

#include "base/file.h"
#include "clip/bvh.h"
#include "clip/text_cursor.h"

namespace panache {
namespace {

namespace fs = std::filesystem;

constexpr size_t kMaxBones = 10'000;
constexpr int kMaxDepth = 1'000;

constexpr double kDegree = 3.14159265358979323846 / 180;

// What a number of a frame moves.
struct Channel {
  bool rotates = false;
  int axis = 0;  // 0 x, 1 y, 2 z.
};

struct Bone {
  std::string name;
  Vec3d tip;   // From its start to its end, file units.
  Quatd axes;  // C.
  std::vector<Channel> channels;
  int parent = -1;
};

// The first is the root.
struct Acclaim {
  std::vector<Bone> bones;  // Parents before children.
  Vec3d root_position;
  double per_degree = kDegree;  // Radians per angle unit of the file; 1 if it uses radians.
};

Quatd turn_about(int axis, double angle) {
  Vec3d v;
  v[axis] = 1;
  return axis_angle(v, angle);
}

// Reads the words of a text, without comments from '#' to the end of a line.
class Words : public TextCursor {
 public:
  Words(std::string_view text, const std::string& name) : TextCursor(text, name) { next(); }

  // Moves to the next word, on this line or a later one.
  void next() {
    skip_space();
    while (!at_end() && word().starts_with('#')) skip_line();
  }
  // Skips a word and everything before the next one.
  bool pass(std::string_view keyword) {
    if (!take(keyword)) return false;
    next();
    return true;
  }
  // Whether the line has more words; words of a line are read with these two.
  bool more_on_line() {
    skip_spaces();
    return !at_line_end();
  }
  std::string take_on_line() {
    std::string text(word());
    take(text);
    return text;
  }
  void skip_line() {
    while (more_on_line()) take_on_line();
    skip_space();
  }
  Result<void> number(double& out, const std::string& of_what) {
    skip_spaces();
    return take_number(out) ? Result<void>() : number_error(of_what);
  }
  Result<void> vector(Vec3d& out, const std::string& of_what) {
    for (double* x : {&out.x, &out.y, &out.z}) {
      if (auto done = number(*x, of_what); !done) return done;
    }
    return {};
  }
};

// Parses an order of axes such as "XYZ".
bool read_order(const std::string& word, std::array<int, 3>& order) {
  if (word.size() != 3) return false;
  for (size_t i = 0; i < 3; ++i) {
    const char c = static_cast<char>(word[i] | 0x20);
    if (c < 'x' || c > 'z') return false;
    order[i] = c - 'x';
  }
  return order[0] != order[1] && order[1] != order[2] && order[0] != order[2];
}

class AsfReader {
 public:
  AsfReader(std::string_view text, const std::string& name) : name_(name), words_(text, name) {}

  Result<Acclaim> read() {
    while (!words_.at_end()) {
      if (auto done = read_section(); !done) return done.error();
    }
    if (!has_root_) return Error{name_ + ": expected ':root', found the end of the file"};
    if (!has_hierarchy_) return Error{name_ + ": expected ':hierarchy', found the end of the file"};
    return order();
  }

 private:
  Result<void> read_section() {
    if (words_.pass(":units")) return read_units();
    if (words_.pass(":root")) return read_root();
    if (words_.pass(":bonedata")) return read_bones();
    if (words_.pass(":hierarchy")) return read_hierarchy();
    if (!words_.word().starts_with(':')) {
      return words_.error("a section such as ':root'");
    }
    skip_section();
    return {};
  }
  void skip_section() {
    do {
      words_.skip_line();
      words_.next();
    } while (!in_next_section());
  }
  bool in_next_section() { return words_.at_end() || words_.word().starts_with(':'); }

  Result<void> read_units() {
    while (!in_next_section()) {
      if (words_.take("angle")) {
        words_.more_on_line();
        const bool radians = words_.is_at("rad");
        if (!radians && !words_.is_at("deg")) return words_.error("deg or rad");
        file_.per_degree = radians ? 1 : kDegree;
      }
      words_.skip_line();
      words_.next();
    }
    return {};
  }

  Result<void> read_root() {
    has_root_ = true;
    root_.name = "root";
    Vec3d orientation;
    std::array<int, 3> order = {0, 1, 2};
    while (!in_next_section()) {
      if (words_.take("order")) {
        if (auto done = read_channels(root_); !done) return done;
      } else if (words_.take("axis")) {
        if (auto done = read_axis_order(order); !done) return done;
      } else if (words_.take("position")) {
        if (auto done = words_.vector(file_.root_position, "the position"); !done) return done;
      } else if (words_.take("orientation")) {
        if (auto done = words_.vector(orientation, "the orientation"); !done) return done;
      } else {
        return words_.error("order, axis, position or orientation");
      }
      words_.next();
    }
    root_.axes = turned(order, orientation);
    return {};
  }

  // The order at the end of an "axis" line.
  Result<void> read_axis_order(std::array<int, 3>& order) {
    words_.more_on_line();
    const std::string word(words_.word());
    if (!read_order(word, order)) return words_.error("an order of axes such as XYZ");
    words_.take_on_line();
    return {};
  }

  Quatd turned(const std::array<int, 3>& order, Vec3d angles) const {
    Quatd q;
    for (const int axis : order) q = turn_about(axis, angles[axis] * file_.per_degree) * q;
    return normalized(q);
  }

  Result<void> read_channels(Bone& bone) {
    while (words_.more_on_line()) {
      const std::string_view word = words_.word();
      const char kind = word.empty() ? ' ' : static_cast<char>(word[0] | 0x20);
      const char axis = word.size() == 2 ? static_cast<char>(word[1] | 0x20) : ' ';
      if ((kind != 't' && kind != 'r') || axis < 'x' || axis > 'z' || bone.channels.size() == 6) {
        return words_.error("degrees of freedom: tx, ty, tz, rx, ry or rz");
      }
      bone.channels.push_back({kind == 'r', axis - 'x'});
      words_.take_on_line();
    }
    return {};
  }

  Result<void> read_bones() {
    while (words_.pass("begin")) {
      if (bones_.size() == kMaxBones) {
        return words_.error("at most " + std::to_string(kMaxBones) + " bones");
      }
      Bone bone;
      if (auto done = read_bone(bone); !done) return done;
      if (bone.name.empty()) return words_.error("a bone with a name before this");
      const std::string name = bone.name;
      if (name == "root" || !bones_.emplace(name, std::move(bone)).second) {
        return words_.error("another name than '" + name + "' for the bone before this");
      }
    }
    if (!in_next_section()) return words_.error("'begin' or the next section");
    return {};
  }

  Result<void> read_bone(Bone& bone) {
    Vec3d direction, angles;
    double size = 0;
    std::array<int, 3> order = {0, 1, 2};
    while (!words_.pass("end")) {
      Result<void> done;
      if (words_.take("name")) {
        words_.more_on_line();
        bone.name = words_.take_on_line();
      } else if (words_.take("direction")) {
        done = words_.vector(direction, "the direction of a bone");
      } else if (words_.take("length")) {
        done = words_.number(size, "the length of a bone");
      } else if (words_.take("axis")) {
        done = words_.vector(angles, "the axis of a bone");
        if (done && words_.more_on_line()) done = read_axis_order(order);
      } else if (words_.take("dof")) {
        done = read_channels(bone);
      } else if (words_.at_end() || words_.word().starts_with(':')) {
        done = words_.error("'end' of a bone");
      } else {
        words_.skip_line();  // Irrelevant for the motion: id, limits, mass, ...
      }
      if (!done) return done;
      words_.next();
    }
    bone.tip = direction * size;
    if (!(length(bone.tip) <= 1e9)) return words_.error("a shorter bone before this");
    bone.axes = turned(order, angles);
    return {};
  }

  Result<void> read_hierarchy() {
    has_hierarchy_ = true;
    if (!words_.pass("begin")) return words_.error("'begin'");
    while (!words_.is_at("end")) {
      if (words_.at_end()) return words_.error("'end' of the hierarchy");
      const std::string parent(words_.word());
      if (parent != "root" && !bones_.contains(parent)) {
        return words_.error("'root' or the name of a bone");
      }
      words_.take_on_line();
      while (words_.more_on_line()) {
        const auto child = bones_.find(std::string(words_.word()));
        if (child == bones_.end()) return words_.error("the name of a bone");
        if (!parents_.emplace(child->first, parent).second) {
          return words_.error("a bone that has no parent yet");
        }
        children_[parent].push_back(child->first);
        words_.take_on_line();
      }
      words_.next();
    }
    words_.pass("end");
    return {};
  }

  // Depth first from the root; bones that are not reached are in a cycle or disconnected.
  Result<Acclaim> order() {
    struct Visit {
      std::string name;
      int parent;
      int depth;
    };
    std::vector<Visit> waiting = {{"root", -1, 1}};
    while (!waiting.empty()) {
      const Visit visit = std::move(waiting.back());
      waiting.pop_back();
      if (visit.depth > kMaxDepth) {
        return Error{name_ + ": expected at most " + std::to_string(kMaxDepth) +
                     " bones one below the other, found more"};
      }
      Bone bone = visit.parent < 0 ? root_ : bones_.at(visit.name);
      bone.parent = visit.parent;
      const int index = static_cast<int>(file_.bones.size());
      file_.bones.push_back(std::move(bone));
      const std::vector<std::string>& below = children_[visit.name];
      for (size_t i = below.size(); i-- > 0;) waiting.push_back({below[i], index, visit.depth + 1});
    }
    if (file_.bones.size() == bones_.size() + 1) return std::move(file_);
    return Error{name_ + ": expected every bone below the root, found " +
                 std::to_string(bones_.size() + 1 - file_.bones.size()) + " that are not"};
  }

  const std::string& name_;
  Words words_;
  bool has_root_ = false, has_hierarchy_ = false;
  Bone root_;
  std::map<std::string, Bone> bones_;
  std::map<std::string, std::string> parents_;
  std::map<std::string, std::vector<std::string>> children_;
  Acclaim file_;
};

Skeleton skeleton_of(const Acclaim& file) {
  Skeleton out;
  std::vector<bool> has_child(file.bones.size());
  for (const Bone& bone : file.bones) {
    Joint joint;
    joint.name = bone.name;
    joint.parent = bone.parent;
    if (bone.parent >= 0) {
      joint.offset = file.bones[bone.parent].tip.as<float>();
      has_child[bone.parent] = true;
    } else {
      joint.offset = file.root_position.as<float>();
    }
    joint.can_rotate = true;
    joint.can_translate = std::any_of(bone.channels.begin(), bone.channels.end(),
                                      [](const Channel& channel) { return !channel.rotates; });
    out.joints.push_back(std::move(joint));
  }
  for (size_t i = 0; i < has_child.size(); ++i) {
    if (!has_child[i]) out.joints[i].ends.push_back(file.bones[i].tip.as<float>());
  }
  return out;
}

class AmcReader {
 public:
  AmcReader(const std::string& text, const std::string& name, const Acclaim& file)
      : words_(text, name),
        file_(file),
        per_degree_(file.per_degree),
        max_poses_(std::max<size_t>(1'000'000, 4 * text.size())) {
    for (size_t i = 0; i < file.bones.size(); ++i) bone_of_.emplace(file.bones[i].name, i);
  }

  Result<Clip> read() {
    clip_.skeleton = skeleton_of(file_);
    clip_.frame_time = 1 / kAmcFrameRate;
    const Clip rest = rest_clip(clip_.skeleton);
    while (words_.word().starts_with(':')) {
      if (words_.is_at(":RADIANS")) per_degree_ = 1;
      if (words_.is_at(":DEGREES")) per_degree_ = kDegree;
      words_.skip_line();
      words_.next();
    }
    while (!words_.at_end()) {
      if (auto done = begin_frame(rest); !done) return done.error();
      uint64_t unused = 0;
      while (!words_.at_end() && !TextCursor(words_).take_count(unused)) {
        if (auto done = read_bone(); !done) return done.error();
      }
    }
    if (clip_.frames == 0) return words_.error("a frame: its number, then its bones");
    return std::move(clip_);
  }

 private:
  // Every frame begins as the one before it.
  Result<void> begin_frame(const Clip& rest) {
    uint64_t number = 0;
    if (size_t(clip_.frames) >= max_poses_ / clip_.joints()) {
      return words_.error("at most " + std::to_string(max_poses_ / clip_.joints()) + " frames of " +
                          std::to_string(clip_.joints()) + " joints in a file of this size");
    }
    if (!words_.take_count(number) || words_.more_on_line()) {
      return words_.error("the number of a frame on a line of its own");
    }
    words_.next();
    clip_.resize(clip_.frames + 1);
    const Pose pose = clip_.pose(clip_.frames - 1);
    const ConstPose before = clip_.frames > 1 ? clip_.pose(clip_.frames - 2) : rest.pose(0);
    std::ranges::copy(before.rotations, pose.rotations.begin());
    std::ranges::copy(before.translations, pose.translations.begin());
    return {};
  }

  Result<void> read_bone() {
    const auto found = bone_of_.find(std::string(words_.word()));
    if (found == bone_of_.end()) return words_.error("the name of a bone of the .asf");
    words_.take_on_line();
    const Bone& bone = file_.bones[found->second];
    const Pose pose = clip_.pose(clip_.frames - 1);
    Quatd turn;
    Vec3d move;
    for (const Channel& channel : bone.channels) {
      double value = 0;
      if (auto done = words_.number(value, "a degree of freedom of " + bone.name); !done) {
        return done;
      }
      if (channel.rotates) {
        turn = turn_about(channel.axis, value * per_degree_) * turn;
      } else {
        move[channel.axis] = value;
      }
    }
    if (words_.more_on_line()) {
      return words_.error("the end of the line after " + std::to_string(bone.channels.size()) +
                          " numbers of " + bone.name);
    }
    pose.rotations[found->second] = normalized(bone.axes * turn * conjugate(bone.axes)).as<float>();
    const Vec3d rest = clip_.skeleton.joints[found->second].offset.as<double>();
    pose.translations[found->second] = (rest + move).as<float>();
    words_.next();
    return {};
  }

  Words words_;
  const Acclaim& file_;
  double per_degree_;
  // Joints times frames. A frame may be a single number, so the bytes do not bound them.
  size_t max_poses_;
  std::map<std::string, size_t> bone_of_;
  Clip clip_;
};

// The skeleton file of an .amc.
Result<std::string> find_asf(const std::string& path) {
  const fs::path amc(path), folder = amc.parent_path();
  const std::string stem = amc.stem().string();
  std::error_code status;
  const std::string subject = stem.substr(0, stem.rfind('_'));
  for (const std::string& name : {subject, stem}) {
    const fs::path asf = folder / (name + ".asf");
    if (fs::is_regular_file(asf, status)) return asf.string();
  }
  std::vector<std::string> found;
  const fs::path where = folder.empty() ? "." : folder;
  for (const auto& entry : fs::directory_iterator(where, status)) {
    if (entry.path().extension() == ".asf")
      found.push_back((folder / entry.path().filename()).string());
  }
  if (found.size() == 1) return found.front();
  return Error{path + ": expected its skeleton beside it as " + subject + ".asf, found " +
               (found.empty() ? "no .asf" : std::to_string(found.size()) + " others")};
}

}  // namespace

Result<Skeleton> parse_asf(const std::string& text, const std::string& name) {
  Result<Acclaim> file = AsfReader(text, name).read();
  if (!file) return file.error();
  return skeleton_of(*file);
}

// The table of formats requires this signature. NOLINTNEXTLINE(performance-unnecessary-value-param)
Result<std::unique_ptr<MotionFile>> parse_amc(std::string text, const std::string& path,
                                              const ReadOptions& options) {
  Result<std::string> asf = find_asf(path);
  if (!asf) return asf.error();
  Result<std::string> bytes = read_file(*asf);
  if (!bytes) return bytes.error();
  Result<Acclaim> skeleton = AsfReader(*bytes, *asf).read();
  if (!skeleton) return skeleton.error();
  Result<Clip> clip = AmcReader(text, path, *skeleton).read();
  if (!clip) return clip.error();
  if (options.fps) clip->frame_time = 1 / *options.fps;
  return parse_bvh(format_bvh(*clip), path);
}

}  // namespace panache

#include "clip/bvh.h"

#include <cassert>
#include <string_view>
#include <utility>

#include "clip/bvh_document.h"
#include "clip/euler.h"
#include "clip/text_cursor.h"

namespace panache {
namespace {

class BvhFile final : public MotionFile {
 public:
  explicit BvhFile(BvhDocument document) : document_(std::move(document)) {}

  std::vector<std::string> clip_names() const override { return {""}; }
  const Clip& clip(int) const override { return document_.clip; }
  Clip rest() const override { return rest_clip(document_.clip.skeleton); }
  std::vector<std::string> notes() const override { return document_.notes; }
  std::string encode(std::span<const ClipEdit> edits, EditMode) const override {
    if (edits.empty()) return document_.text;
    assert(edits.size() == 1);
    if (edits.front().clip == kNewClip) return format_bvh(*edits.front().changed);
    return encode_bvh(document_, *edits.front().changed, edits.front().source_frames);
  }

 private:
  BvhDocument document_;
};

}  // namespace

Result<std::unique_ptr<MotionFile>> parse_bvh(std::string text, const std::string& name,
                                              const ReadOptions& options) {
  if (options.fps) {
    Result<std::string> corrected = with_bvh_rate(text, name, *options.fps);
    if (!corrected) return corrected.error();
    text = *std::move(corrected);
  }
  auto document = read_bvh_document(std::move(text), name);
  if (!document) return document.error();
  return std::unique_ptr<MotionFile>(std::make_unique<BvhFile>(std::move(*document)));
}

namespace {

constexpr int kDecimals = 6;
constexpr EulerOrder kOrder = {3, {2, 0, 1}};
constexpr const char* kRotationNames = "Zrotation Xrotation Yrotation";
constexpr const char* kPositionNames = "Xposition Yposition Zposition";

class BvhFormatter {
 public:
  explicit BvhFormatter(const Clip& clip)
      : clip_(clip), order_(depth_first(clip.skeleton)), angles_(clip.joints()) {}

  std::string format() {
    append_hierarchy();
    out_ += "MOTION\nFrames: " + std::to_string(clip_.frames) + "\nFrame Time: ";
    append_fixed(out_, clip_.frame_time, 9);
    out_ += '\n';
    for (int i = 0; i < clip_.frames; ++i) append_frame(clip_.pose(i));
    return std::move(out_);
  }

 private:
  struct Visit {
    size_t joint;
    size_t depth;
  };

  // BVH files list joints depth first; a skeleton need not.
  static std::vector<Visit> depth_first(const Skeleton& skeleton) {
    const size_t count = skeleton.joints.size();
    std::vector<std::vector<size_t>> children(count + 1);  // The last holds the roots.
    for (size_t j = count; j-- > 0;) {
      const int parent = skeleton.joints[j].parent;
      children[parent < 0 ? count : static_cast<size_t>(parent)].push_back(j);
    }
    std::vector<Visit> order, waiting;
    for (const size_t root : children[count]) waiting.push_back({root, 0});
    while (!waiting.empty()) {
      const Visit visit = waiting.back();
      waiting.pop_back();
      order.push_back(visit);
      for (const size_t child : children[visit.joint]) waiting.push_back({child, visit.depth + 1});
    }
    return order;
  }

  bool translates(size_t joint) const {
    const Joint& j = clip_.skeleton.joints[joint];
    return j.parent < 0 || j.can_translate;
  }

  void append_hierarchy() {
    out_ = "HIERARCHY\n";
    size_t depth = 0;  // Joints still open.
    for (const Visit& visit : order_) {
      while (depth > visit.depth) close(--depth);
      append_joint(visit);
      ++depth;
    }
    while (depth > 0) close(--depth);
  }

  void close(size_t depth) { indent(depth) += "}\n"; }

  void append_joint(const Visit& visit) {
    const Joint& joint = clip_.skeleton.joints[visit.joint];
    indent(visit.depth) += joint.parent < 0 ? "ROOT " : "JOINT ";
    append_name(joint.name, visit.joint);
    out_ += '\n';
    indent(visit.depth) += "{\n";
    append_offset(joint.offset, visit.depth + 1);
    indent(visit.depth + 1) += "CHANNELS ";
    if (translates(visit.joint)) {
      out_ += std::string("6 ") + kPositionNames + " " + kRotationNames + "\n";
    } else {
      out_ += std::string("3 ") + kRotationNames + "\n";
    }
    for (const Vec3 end : joint.ends) {
      indent(visit.depth + 1) += "End Site\n";
      indent(visit.depth + 1) += "{\n";
      append_offset(end, visit.depth + 2);
      close(visit.depth + 1);
    }
  }

  // A name must stay on its line and must not be a brace, or the file cannot be read back.
  void append_name(std::string_view name, size_t joint) {
    if (name.find_first_not_of(" \t") == std::string_view::npos) {
      out_ += "joint" + std::to_string(joint);
      return;
    }
    for (const char c : name) {
      const bool breaks = static_cast<unsigned char>(c) < 0x20 || c == '{' || c == '}';
      out_ += breaks ? '_' : c;
    }
  }

  void append_offset(Vec3 offset, size_t depth) {
    indent(depth) += "OFFSET ";
    append_vector(offset);
    out_ += '\n';
  }

  void append_vector(Vec3 v) {
    append_fixed(out_, v.x, kDecimals);
    append_fixed(out_ += ' ', v.y, kDecimals);
    append_fixed(out_ += ' ', v.z, kDecimals);
  }

  void append_frame(ConstPose pose) {
    bool first = true;
    for (const Visit& visit : order_) {
      const size_t j = visit.joint;
      if (!first) out_ += ' ';
      first = false;
      if (translates(j)) {
        append_vector(pose.translations[j]);
        out_ += ' ';
      }
      angles_[j] = quat_to_euler(kOrder, pose.rotations[j].as<double>(), angles_[j]);
      for (size_t k = 0; k < 3; ++k) {
        if (k > 0) out_ += ' ';
        append_fixed(out_, angles_[j][k], kDecimals);
      }
    }
    out_ += '\n';
  }

  std::string& indent(size_t depth) { return out_.append(2 * depth, ' '); }

  const Clip& clip_;
  std::vector<Visit> order_;
  std::vector<EulerAngles> angles_;  // [joints] of the frame before
  std::string out_;
};

}  // namespace

void add_end_sites(Skeleton& skeleton) {
  std::vector<bool> has_child(skeleton.joints.size());
  for (const Joint& joint : skeleton.joints) {
    if (joint.parent >= 0) has_child[joint.parent] = true;
  }
  for (size_t j = 0; j < skeleton.joints.size(); ++j) {
    std::vector<Vec3>& ends = skeleton.joints[j].ends;
    if (!has_child[j] && ends.empty()) ends.emplace_back();
  }
}

std::string format_bvh(const Clip& clip) { return BvhFormatter(clip).format(); }

}  // namespace panache

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#include "clip/bvh.h"
#include "clip/bvh_document.h"
#include "clip/text_cursor.h"

namespace panache {
namespace {

struct ChannelName {
  const char* name;
  bool rotates;
  int axis;
};
constexpr ChannelName kChannelNames[] = {{"Xposition", false, 0}, {"Yposition", false, 1},
                                         {"Zposition", false, 2}, {"Xrotation", true, 0},
                                         {"Yrotation", true, 1},  {"Zrotation", true, 2}};
constexpr uint64_t kMaxChannels = 6;

std::string plural(uint64_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

class BvhReader {
 public:
  // Fills `document`, whose text is there already.
  BvhReader(BvhDocument& document, const std::string& name)
      : document_(document), clip_(document.clip), cursor_(document.text, name) {}

  Result<void> read() {
    if (auto done = read_hierarchy(); !done) return done;
    if (auto done = read_motion_head(); !done) return done;
    return read_frames();
  }

 private:
  // HIERARCHY and the joints, up to and with MOTION. No recursion: the depth is the file's to
  // choose.
  Result<void> read_hierarchy() {
    cursor_.skip_space();
    if (!cursor_.take("HIERARCHY")) return cursor_.error("'HIERARCHY'");
    std::vector<int> open;  // Joints whose closing brace is still to come, outermost first.
    for (;;) {
      cursor_.skip_space();
      if (cursor_.is_at("ROOT") || cursor_.is_at("JOINT")) {
        if (auto done = read_joint(open); !done) return done;
      } else if (open.empty()) {
        if (joints().empty()) return cursor_.error("'ROOT'");
        if (!cursor_.take("MOTION")) return cursor_.error("'ROOT' or 'MOTION'");
        break;
      } else if (cursor_.take("}")) {
        open.pop_back();
      } else if (cursor_.is_at("End")) {
        if (auto done = read_end_site(joints()[static_cast<size_t>(open.back())]); !done) {
          return done;
        }
      } else {
        const Joint& joint = joints()[static_cast<size_t>(open.back())];
        return cursor_.error("'JOINT', 'End Site' or '}' in joint " + quoted(joint.name));
      }
    }
    if (document_.numbers == 0) {
      return cursor_.error("a joint with channels before the motion");
    }
    return {};
  }

  // From ROOT or JOINT to the end of CHANNELS.
  Result<void> read_joint(std::vector<int>& open) {
    if (joints().size() == static_cast<size_t>(kBvhMaxJoints)) {
      return cursor_.error("at most " + plural(kBvhMaxJoints, "joint"));
    }
    if (open.size() == static_cast<size_t>(kBvhMaxDepth)) {
      return cursor_.error("joints nested at most " + std::to_string(kBvhMaxDepth) + " deep");
    }
    const std::string keyword = cursor_.is_at("ROOT") ? "'ROOT'" : "'JOINT'";
    cursor_.take(cursor_.word());
    Joint joint;
    joint.parent = open.empty() ? -1 : open.back();
    joint.name = cursor_.take_name();
    if (joint.name.empty()) return cursor_.error("a name after " + keyword);
    if (auto done = read_offset("joint " + quoted(joint.name), joint.offset); !done) return done;
    open.push_back(static_cast<int>(joints().size()));
    joints().push_back(std::move(joint));
    return read_channels(joints().back());
  }

  Result<void> read_end_site(Joint& joint) {
    cursor_.take("End");
    cursor_.skip_spaces();
    if (!cursor_.take("Site")) return cursor_.error("'Site' after 'End'");
    cursor_.take_name();  // Some programs name End Sites; a point fixed to a joint needs no name.
    const std::string owner = "an End Site of joint " + quoted(joint.name);
    Vec3 point;
    if (auto done = read_offset(owner, point); !done) return done;
    joint.ends.push_back(point);
    cursor_.skip_space();
    if (!cursor_.take("}")) return cursor_.error("'}' of " + owner);
    return {};
  }

  // { OFFSET x y z
  Result<void> read_offset(const std::string& owner, Vec3& offset) {
    cursor_.skip_space();
    if (!cursor_.take("{")) return cursor_.error("'{' of " + owner);
    cursor_.skip_space();
    if (!cursor_.take("OFFSET")) return cursor_.error("'OFFSET' of " + owner);
    double xyz[3];
    for (int axis = 0; axis < 3; ++axis) {
      cursor_.skip_spaces();
      if (!cursor_.take_number(xyz[axis])) {
        return cursor_.number_error(std::string(1, "xyz"[axis]) + " of the OFFSET of " + owner);
      }
    }
    offset = Vec3d{xyz[0], xyz[1], xyz[2]}.as<float>();
    return {};
  }

  // CHANNELS n and n names
  Result<void> read_channels(Joint& joint) {
    const std::string owner = "joint " + quoted(joint.name);
    cursor_.skip_space();
    if (!cursor_.take("CHANNELS")) {
      return cursor_.error("'CHANNELS' of " + owner + " ('CHANNELS 0' where it does not move)");
    }
    cursor_.skip_spaces();
    const TextCursor before = cursor_;
    uint64_t count = 0;
    if (!cursor_.take_count(count) || count > kMaxChannels) {
      return before.error("a number of channels from 0 to 6 for " + owner);
    }
    BvhChannels channels;
    for (uint64_t i = 0; i < count; ++i) {
      cursor_.skip_space();
      const std::string which =
          "channel " + std::to_string(i + 1) + " of " + std::to_string(count) + " of " + owner;
      if (auto done = read_channel(which, channels); !done) return done;
    }
    cursor_.skip_space();
    if (find_channel()) {
      return cursor_.error("no more than the " + plural(count, "channel") + " that " + owner +
                           " announces");
    }
    joint.can_rotate = channels.order.count > 0;
    joint.can_translate = channels.position != BvhChannels().position;
    document_.channels.push_back(channels);
    return {};
  }

  // One channel name, with its place in the numbers of a frame.
  Result<void> read_channel(const std::string& which, BvhChannels& channels) {
    const ChannelName* channel = find_channel();
    if (!channel) {
      return cursor_.error(
          "Xposition, Yposition, Zposition, Xrotation, Yrotation or Zrotation as " + which);
    }
    const auto axis_end = channels.order.axis.begin() + channels.order.count;
    const bool again =
        channel->rotates
            ? std::find(channels.order.axis.begin(), axis_end, channel->axis) != axis_end
            : channels.position[static_cast<size_t>(channel->axis)] >= 0;
    if (again) return cursor_.error("a channel that the joint does not have yet as " + which);
    cursor_.take(channel->name);
    if (channel->rotates) {
      const size_t place = static_cast<size_t>(channels.order.count++);
      channels.order.axis[place] = channel->axis;
      channels.rotation[place] = document_.numbers;
    } else {
      channels.position[static_cast<size_t>(channel->axis)] = document_.numbers;
    }
    ++document_.numbers;
    return {};
  }

  // The channel whose name stands here, if one does.
  const ChannelName* find_channel() const {
    for (const ChannelName& channel : kChannelNames) {
      if (cursor_.is_at(channel.name)) return &channel;
    }
    return nullptr;
  }

  // Frames: and Frame Time:
  Result<void> read_motion_head() {
    cursor_.skip_space();
    if (!cursor_.take_label("Frames")) return cursor_.error("'Frames:' after 'MOTION'");
    cursor_.skip_spaces();
    const TextCursor before_count = cursor_;
    document_.count_begin = cursor_.offset();
    if (!cursor_.take_count(announced_)) return before_count.error("a number of frames");
    document_.count_end = cursor_.offset();
    if (announced_ > max_frames()) return before_count.error(at_most(max_frames()));
    // A number takes a byte at least, and a space or line end each but for the last.
    const uint64_t room =
        (cursor_.remaining() + 1) / (2 * static_cast<uint64_t>(document_.numbers));
    if (announced_ > room) {
      Error error = before_count.error("at most " + plural(room, "frame") + " in the " +
                                       plural(cursor_.remaining(), "byte") + " that follow");
      error.message += "; the file is cut short or the count is wrong";
      return error;
    }

    cursor_.skip_space();
    if (!cursor_.take_label("Frame Time")) return cursor_.error("'Frame Time:' after 'Frames:'");
    cursor_.skip_spaces();
    const TextCursor before_time = cursor_;
    if (!cursor_.take_number(clip_.frame_time)) return cursor_.number_error("the frame time");
    if (clip_.frame_time < kBvhMinFrameTime) {
      return before_time.error("a frame time of a millionth of a second or more");
    }
    cursor_.skip_spaces();
    if (!cursor_.at_line_end()) return cursor_.error("the end of the line after the frame time");
    return {};
  }

  // A joint without channels takes memory in every frame but no byte of the file, so the bytes
  // alone do not bound the poses. This does, far above what any honest file needs.
  uint64_t max_frames() const {
    const uint64_t poses =
        std::max<uint64_t>(1'000'000, uint64_t{4} * static_cast<uint64_t>(document_.text.size()));
    return std::min<uint64_t>(poses / joints().size(), std::numeric_limits<int>::max());
  }
  std::string at_most(uint64_t frames) const {
    return "at most " + plural(frames, "frame") + " for a skeleton of " +
           plural(joints().size(), "joint") + " in a file of " +
           plural(document_.text.size(), "byte");
  }

  // The table to the end of the file. The announced count must be reached; as in Blender, it may be
  // exceeded.
  Result<void> read_frames() {
    std::vector<double> numbers(static_cast<size_t>(document_.numbers));
    document_.lines.reserve(static_cast<size_t>(announced_));
    clip_.resize(static_cast<int>(announced_));
    uint64_t frame = 0;
    for (;; ++frame) {
      cursor_.skip_space();
      if (cursor_.at_end()) break;
      if (frame == max_frames()) return cursor_.error(at_most(frame));
      if (frame == static_cast<uint64_t>(clip_.frames)) {
        clip_.resize(static_cast<int>(std::min(max_frames(), frame + frame / 2 + 16)));
      }
      document_.lines.push_back(cursor_.line_begin());
      if (auto done = read_line(frame, numbers); !done) return done;
      set_pose(numbers, clip_.pose(static_cast<int>(frame)));
    }
    if (frame < announced_) {
      const std::string cure =
          frame > 0 ? "; a count of " + std::to_string(frame) + " reads what is there" : "";
      Error error = cursor_.error("frame " + std::to_string(frame + 1) + " of the " +
                                  std::to_string(announced_) + " announced");
      error.message += cure;
      return error;
    }
    if (frame == 0) return cursor_.error("a frame at least");
    clip_.resize(static_cast<int>(frame));
    return {};
  }

  Result<void> read_line(uint64_t frame, std::vector<double>& numbers) {
    for (size_t i = 0; i < numbers.size(); ++i) {
      cursor_.skip_spaces();
      if (cursor_.take_number(numbers[i])) continue;
      if (i == 0 && frame > 0 && frame >= announced_) {
        return cursor_.error("a frame or the end of the file after the " +
                             plural(announced_, "frame") + " announced");
      }
      return cursor_.number_error(number_name(static_cast<int>(i)));
    }
    cursor_.skip_spaces();
    if (!cursor_.at_line_end()) {
      return cursor_.error("the end of the line after the " + plural(numbers.size(), "number") +
                           " of a frame");
    }
    return {};
  }

  // "channel 3 of joint 'Hips'" for a place in the numbers of a frame.
  std::string number_name(int number) const {
    size_t joint = 0;
    int first = 0;
    for (;; ++joint) {
      const int count = channel_count(document_.channels[joint]);
      if (number < first + count) break;
      first += count;
    }
    return "channel " + std::to_string(number - first + 1) + " of joint " +
           quoted(joints()[joint].name);
  }
  static int channel_count(const BvhChannels& channels) {
    const auto& position = channels.position;
    return channels.order.count +
           static_cast<int>(std::count_if(position.begin(), position.end(),
                                          [](int place) { return place >= 0; }));
  }

  void set_pose(const std::vector<double>& numbers, Pose pose) const {
    for (size_t j = 0; j < joints().size(); ++j) {
      const BvhChannels& channels = document_.channels[j];
      const auto number = [&](int place) { return numbers[static_cast<size_t>(place)]; };
      Vec3& t = pose.translations[j];
      t = joints()[j].offset;
      if (channels.position[0] >= 0) t.x = static_cast<float>(number(channels.position[0]));
      if (channels.position[1] >= 0) t.y = static_cast<float>(number(channels.position[1]));
      if (channels.position[2] >= 0) t.z = static_cast<float>(number(channels.position[2]));
      EulerAngles angles = {0, 0, 0};
      for (size_t i = 0; i < static_cast<size_t>(channels.order.count); ++i) {
        angles[i] = number(channels.rotation[i]);
      }
      pose.rotations[j] = euler_to_quat(channels.order, angles).as<float>();
    }
  }

  std::vector<Joint>& joints() { return clip_.skeleton.joints; }
  const std::vector<Joint>& joints() const { return clip_.skeleton.joints; }

  BvhDocument& document_;
  Clip& clip_;
  TextCursor cursor_;
  uint64_t announced_ = 0;  // Frames that the file says it has.
};

}  // namespace

Result<BvhDocument> read_bvh_document(std::string text, const std::string& name) {
  BvhDocument document;
  document.text = std::move(text);
  if (auto done = BvhReader(document, name).read(); !done) return done.error();
  return document;
}

}  // namespace panache

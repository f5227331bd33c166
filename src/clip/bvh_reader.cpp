#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#include "base/text.h"
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

class BvhReader {
 public:
  // Fills `document`, whose text is there already.
  BvhReader(BvhDocument& document, const std::string& name)
      : document_(document),
        clip_(document.clip),
        cursor_(document.text, name),
        before_count_(cursor_) {}

  Result<void> read() {
    if (auto done = read_hierarchy(); !done) return done;
    if (auto done = read_count(); !done) return done;
    if (auto done = read_frame_time(); !done) return done;
    return read_frames();
  }

  // Finds the frame time without parsing it: the rest of the line of "Frame Time:", or the position
  // where that line is missing.
  struct RateText {
    size_t begin = 0, end = 0;
    bool has_label = false;
  };
  Result<RateText> find_rate() {
    if (auto done = read_hierarchy(); !done) return done.error();
    if (auto done = read_count(); !done) return done.error();
    cursor_.skip_space();
    RateText rate;
    rate.has_label = cursor_.take_label("Frame Time");
    cursor_.skip_spaces();
    rate.begin = rate.end = cursor_.offset();
    if (rate.has_label) cursor_.take_name(), rate.end = cursor_.offset();
    return rate;
  }

 private:
  // HIERARCHY and the joints, up to and including MOTION. No recursion, because the file determines
  // the depth.
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
        if (auto done = read_end_site(joints()[open.back()]); !done) {
          return done;
        }
      } else {
        const Joint& joint = joints()[open.back()];
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
    if (joints().size() == size_t(kBvhMaxJoints)) {
      return cursor_.error("at most " + plural(kBvhMaxJoints, "joint"));
    }
    if (open.size() == size_t(kBvhMaxDepth)) {
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

  // One channel name, with its index in the numbers of a frame.
  Result<void> read_channel(const std::string& which, BvhChannels& channels) {
    const ChannelName* channel = find_channel();
    if (!channel) {
      return cursor_.error(
          "Xposition, Yposition, Zposition, Xrotation, Yrotation or Zrotation as " + which);
    }
    const auto axis_end = channels.order.axis.begin() + channels.order.count;
    const bool again = channel->rotates ? std::find(channels.order.axis.begin(), axis_end,
                                                    channel->axis) != axis_end
                                        : channels.position[channel->axis] >= 0;
    if (again) return cursor_.error("a channel that the joint does not have yet as " + which);
    cursor_.take(channel->name);
    if (channel->rotates) {
      const int slot = channels.order.count++;
      channels.order.axis[slot] = channel->axis;
      channels.rotation[slot] = document_.numbers;
    } else {
      channels.position[channel->axis] = document_.numbers;
    }
    ++document_.numbers;
    return {};
  }

  // The channel with the name at the cursor, if any.
  const ChannelName* find_channel() const {
    for (const ChannelName& channel : kChannelNames) {
      if (cursor_.is_at(channel.name)) return &channel;
    }
    return nullptr;
  }

  Result<void> read_count() {
    cursor_.skip_space();
    if (!cursor_.take_label("Frames")) return cursor_.error("'Frames:' after 'MOTION'");
    cursor_.skip_spaces();
    before_count_ = cursor_;
    document_.count_begin = cursor_.offset();
    if (!cursor_.take_count(announced_)) return before_count_.error("a number of frames");
    document_.count_end = cursor_.offset();
    return {};
  }

  Result<void> read_frame_time() {
    cursor_.skip_space();
    if (!cursor_.take_label("Frame Time")) {
      return without_rate(cursor_.error("'Frame Time:' after 'Frames:'"));
    }
    cursor_.skip_spaces();
    const TextCursor before_time = cursor_;
    if (!cursor_.take_number(clip_.frame_time)) {
      return without_rate(cursor_.number_error("the frame time"));
    }
    if (clip_.frame_time < kBvhMinFrameTime) {
      return without_rate(before_time.error("a frame time of a millionth of a second or more"));
    }
    cursor_.skip_spaces();
    if (!cursor_.at_line_end()) {
      return without_rate(cursor_.error("the end of the line after the frame time"));
    }
    return {};
  }
  static Error without_rate(Error error) {
    error.message += std::string("; ") + kGiveRate;
    error.kind = ErrorKind::rate_needed;
    return error;
  }

  // A joint without channels takes memory in every frame but no byte of the file, so the file size
  // does not bound the poses. This does, far above what any honest file needs.
  uint64_t max_frames() const {
    const uint64_t poses = std::max<uint64_t>(1'000'000, 4 * document_.text.size());
    return std::min<uint64_t>(poses / joints().size(), std::numeric_limits<int>::max());
  }
  std::string frame_limit(uint64_t frames) const {
    return "at most " + plural(frames, "frame") + " for a skeleton of " +
           plural(joints().size(), "joint") + " in a file of " +
           plural(document_.text.size(), "byte");
  }

  // An upper bound of the rows that can follow if the count is right. A number takes at least a
  // byte, and a space or line end, except for the last.
  uint64_t likely_frames() const {
    const uint64_t room = (cursor_.remaining() + 1) / (2 * document_.numbers);
    return std::min({announced_, room, max_frames()});
  }

  // The table up to the end of the file, as in Blender, whatever the announced count is.
  Result<void> read_frames() {
    std::vector<double> numbers(document_.numbers);
    document_.lines.reserve(likely_frames());
    clip_.resize(static_cast<int>(likely_frames()));
    uint64_t frame = 0;
    for (;; ++frame) {
      cursor_.skip_space();
      if (cursor_.at_end()) break;
      if (frame == max_frames()) return cursor_.error(frame_limit(frame));
      if (frame == static_cast<uint64_t>(clip_.frames)) {
        clip_.resize(static_cast<int>(std::min(max_frames(), frame + frame / 2 + 16)));
      }
      if (frame > 0 && is_cut_row()) break;
      document_.lines.push_back(cursor_.line_begin());
      if (auto done = read_line(frame, numbers); !done) return done;
      set_pose(numbers, clip_.pose(static_cast<int>(frame)));
    }
    if (frame == 0) return cursor_.error("a frame at least");
    clip_.resize(static_cast<int>(frame));
    document_.count_fits = frame == announced_;
    if (!document_.count_fits) note_count(frame);
    return {};
  }

  // Whether this row is the last in the file and is cut, so that only the beginning is there. If
  // so, notes it.
  bool is_cut_row() {
    TextCursor ahead = cursor_;
    int count = 0;
    for (double unused; ahead.take_number(unused); ahead.skip_spaces()) ++count;
    const TextCursor end = ahead;
    if (count >= document_.numbers) return false;
    if (is_cut_number(ahead.word())) {
      ahead.take(ahead.word());
    } else {
      ahead.skip_space();
    }
    if (!ahead.at_end()) return false;
    document_.cut_row = cursor_.line_begin();
    document_.notes.push_back(end.error("channel " + std::to_string(count + 1) + " of " +
                                        std::to_string(document_.numbers) + " in the last row")
                                  .message +
                              "; this row is left out");
    return true;
  }
  // Whether the word is the beginning of a number but not a number: "-", "1.5e".
  static bool is_cut_number(std::string_view word) {
    return !word.empty() && std::string_view("+-.eE").find(word.back()) != std::string_view::npos &&
           word.find_first_not_of("+-.0123456789eE") == std::string_view::npos;
  }

  void note_count(uint64_t rows) {
    document_.notes.push_back(
        before_count_
            .error("a count of " + std::to_string(rows) + ", that of the complete rows that follow")
            .message +
        (rows == 1 ? "; that one is read" : "; all of them are read") +
        (rows < announced_ ? ", and the file may be cut short" : ""));
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

  // "channel 3 of joint 'Hips'" for an index in the numbers of a frame.
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
           static_cast<int>(
               std::count_if(position.begin(), position.end(), [](int slot) { return slot >= 0; }));
  }

  void set_pose(const std::vector<double>& numbers, Pose pose) const {
    for (size_t j = 0; j < joints().size(); ++j) {
      const BvhChannels& channels = document_.channels[j];
      Vec3& t = pose.translations[j];
      t = joints()[j].offset;
      if (channels.position[0] >= 0) t.x = static_cast<float>(numbers[channels.position[0]]);
      if (channels.position[1] >= 0) t.y = static_cast<float>(numbers[channels.position[1]]);
      if (channels.position[2] >= 0) t.z = static_cast<float>(numbers[channels.position[2]]);
      EulerAngles angles = {0, 0, 0};
      for (int i = 0; i < channels.order.count; ++i) {
        angles[i] = numbers[channels.rotation[i]];
      }
      pose.rotations[j] = euler_to_quat(channels.order, angles).as<float>();
    }
  }

  std::vector<Joint>& joints() { return clip_.skeleton.joints; }
  const std::vector<Joint>& joints() const { return clip_.skeleton.joints; }

  BvhDocument& document_;
  Clip& clip_;
  TextCursor cursor_;
  TextCursor before_count_;
  uint64_t announced_ = 0;  // Frame count according to the file.
};

}  // namespace

Result<std::string> with_bvh_rate(const std::string& text, const std::string& name, double fps) {
  BvhDocument document;
  document.text = text;
  Result<BvhReader::RateText> rate = BvhReader(document, name).find_rate();
  if (!rate) return rate.error();
  std::string time;
  append_fixed(time, 1 / fps, 9);
  if (!rate->has_label) time = "Frame Time: " + time + "\n";
  if (rate->has_label && text[rate->begin - 1] == ':') time = " " + time;
  document.text.replace(rate->begin, rate->end - rate->begin, time);
  return std::move(document.text);
}

Result<BvhDocument> read_bvh_document(std::string text, const std::string& name) {
  BvhDocument document;
  document.text = std::move(text);
  if (auto done = BvhReader(document, name).read(); !done) return done.error();
  return document;
}

}  // namespace panache

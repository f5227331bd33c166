#include <algorithm>
#include <cassert>
#include <cmath>
#include <string_view>

#include "clip/bvh_document.h"
#include "clip/text_cursor.h"

namespace panache {
namespace {

// Writes frames in the formatting of the file: its spaces, its line ends and, where nothing
// changed, its digits.
class BvhEncoder {
 public:
  explicit BvhEncoder(const BvhDocument& document)
      : document_(document),
        words_(numbers()),
        source_(numbers()),
        previous_source_(numbers()),
        written_(numbers()),
        changed_(numbers()) {
    decimals_ = find_decimals();
  }

  std::string encode(const Clip& changed, std::span<const double> source_frames) {
    const std::string_view text = document_.text;
    const Clip& clip = document_.clip;
    std::string out;
    out.reserve(text.size() / clip.frames * (changed.frames + 1) + document_.lines[0]);
    append_head(out, changed.frames);
    bool same = changed.frames == clip.frames;
    for (int i = 0; i < changed.frames; ++i) {
      const int nearest = nearest_frame(source_frames[i]);
      split_line(nearest);
      choose_numbers(changed.pose(i), clip.pose(nearest), i == 0);
      same =
          same && nearest == i && std::find(changed_.begin(), changed_.end(), 1) == changed_.end();
      append_line(out, nearest);
      if (i + 1 < changed.frames) append_gap(out, nearest);
    }
    if (same) return document_.text;
    split_line(clip.frames - 1);
    return out += text.substr(line_end_, document_.cut_row - line_end_);
  }

 private:
  size_t numbers() const { return document_.numbers; }

  int nearest_frame(double source_frame) const {
    const double last = document_.clip.frames - 1;
    return source_frame > 0 ? static_cast<int>(std::lround(std::min(source_frame, last))) : 0;
  }

  // As many as the file uses. The first frame may be a rest pose of whole numbers, so several
  // frames are checked; a float needs no more than nine.
  int find_decimals() {
    int max = 4;
    for (int frame = 0; frame < std::min(document_.clip.frames, 16); ++frame) {
      split_line(frame);
      for (const std::string_view word : words_) max = std::max(max, decimals_of(word));
    }
    return std::min(max, 9);
  }

  // Splits a line of the file into words and numbers, and finds its end.
  void split_line(int frame) {
    const size_t begin = document_.lines[frame];
    TextCursor cursor(std::string_view(document_.text).substr(begin), "");
    for (size_t i = 0; i < numbers(); ++i) {
      cursor.skip_spaces();
      const size_t word = cursor.offset();
      [[maybe_unused]] const bool number = cursor.take_number(source_[i]);
      assert(number);  // It was valid when it was read.
      words_[i] = std::string_view(document_.text).substr(begin + word, cursor.offset() - word);
    }
    cursor.skip_spaces();
    line_end_ = begin + cursor.offset();
  }

  // Everything before the first frame, with the new count.
  void append_head(std::string& out, int frames) const {
    const std::string_view text = document_.text;
    const size_t first_line = document_.lines[0];
    if (frames == document_.clip.frames && document_.count_fits) {
      out += text.substr(0, first_line);
      return;
    }
    out += text.substr(0, document_.count_begin);
    out += std::to_string(frames);
    out += text.substr(document_.count_end, first_line - document_.count_end);
  }

  // Chooses the numbers of a frame: those of the file, in source_, or new ones.
  void choose_numbers(ConstPose pose, ConstPose source_pose, bool first) {
    if (first) {
      previous_source_ = source_;
      written_ = source_;
    }
    for (size_t j = 0; j < document_.channels.size(); ++j) {
      const BvhChannels& channels = document_.channels[j];
      const Vec3 t = pose.translations[j], s = source_pose.translations[j];
      choose(channels.position[0], t.x == s.x, t.x);
      choose(channels.position[1], t.y == s.y, t.y);
      choose(channels.position[2], t.z == s.z, t.z);
      const bool same = pose.rotations[j] == source_pose.rotations[j];
      const EulerAngles angles =
          same ? EulerAngles{} : near_angles(channels, pose.rotations[j].as<double>());
      for (int i = 0; i < channels.order.count; ++i) {
        choose(channels.rotation[i], same, angles[i]);
      }
    }
    previous_source_ = source_;
  }
  void choose(int i, bool same, double value) {
    if (i < 0) return;
    changed_[i] = !same;
    written_[i] = same ? source_[i] : value;
  }

  // Angles for a new rotation. They follow the file's: they start near its numbers and change from
  // frame to frame as these do, jumps of a whole turn included. So they wrap where the file does
  // and nowhere else, even if the new rotation is half a turn from the old.
  EulerAngles near_angles(const BvhChannels& channels, Quatd rotation) const {
    EulerAngles near = {0, 0, 0};
    for (int k = 0; k < channels.order.count; ++k) {
      const int i = channels.rotation[k];
      near[k] = written_[i] + (source_[i] - previous_source_[i]);
    }
    return quat_to_euler(channels.order, rotation, near);
  }

  void append_line(std::string& out, int nearest) const {
    size_t at = document_.lines[nearest];
    const char* const text = document_.text.data();
    for (size_t i = 0; i < numbers(); ++i) {
      if (!changed_[i]) continue;  // Copied with the piece that ends at the next changed number.
      const size_t word = words_[i].data() - text;
      out.append(text + at, word - at);
      append_fixed(out, written_[i], decimals_);
      at = word + words_[i].size();
    }
    out.append(text + at, line_end_ - at);
  }

  // The separator from this line to the next: the file's own line end, empty lines included.
  void append_gap(std::string& out, int nearest) const {
    const std::string_view text = document_.text;
    if (nearest + 1 < document_.clip.frames) {
      const size_t next = document_.lines[nearest + 1];
      out += text.substr(line_end_, next - line_end_);
      return;
    }
    // The last line may end the file; the line before the first frame cannot.
    size_t begin = document_.lines[0];
    const size_t end = begin--;
    if (text[begin] == '\n' && text[begin - 1] == '\r') --begin;
    out += text.substr(begin, end - begin);
  }

  const BvhDocument& document_;
  std::vector<std::string_view> words_;  // [numbers] of the line in hand
  std::vector<double> source_;           // [numbers] of the line in hand
  std::vector<double> previous_source_;  // [numbers] of the source line of the frame before
  std::vector<double> written_;          // [numbers] of the frame before, then of this one
  std::vector<char> changed_;            // [numbers] 1 where written_ differs from the file's
  size_t line_end_ = 0;                  // End of the current line, before its line end.
  int decimals_ = 4;
};

}  // namespace

std::string encode_bvh(const BvhDocument& document, const Clip& changed,
                       std::span<const double> source_frames) {
  assert(changed.joints() == document.clip.joints());
  assert(source_frames.size() == size_t(changed.frames));
  return BvhEncoder(document).encode(changed, source_frames);
}

}  // namespace panache

// panache live send: plays a motion file as a tracker would send it (VMC protocol).

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "input.h"
#include "messages.h"
#include "rig/canonical_body.h"
#include "rig/posed_rig.h"
#include "rig_options.h"
#include "stop_signal.h"
#include "verbs.h"
#include "vmc_bones.h"
#include "vmc_messages.h"
#include "vmc_socket.h"

namespace panache::cli {
namespace {

struct SendOptions {
  std::string input, to = "39539", clip;
  std::optional<double> fps, seconds;
  bool loop = false;
  RigFlags rig;
};

// VRM's name is Unity's with a lower-case first letter.
int bone_of(int human_joint) {
  std::string name(human_joint_name(human_joint));
  name[0] = static_cast<char>(name[0] - 'a' + 'A');
  return find_vmc_bone(name).value();
}

// Reads poses of a clip as bones of the canonical body, whose rotations are zero in T-pose.
class Player {
 public:
  Player(const Clip& clip, Rig rig)
      : clip_(clip), rig_(std::move(rig)), pose_(rest_clip(clip.skeleton)) {
    for (int j = 0; j < kHumanJoints; ++j) bones_[j] = bone_of(j);
  }

  // The motion's length in seconds, from its first usable frame to its last.
  double duration() const {
    return (clip_.frames - 1 - rig_.rig().first_frame()) * clip_.frame_time;
  }

  // `at`: seconds into the motion.
  std::vector<VmcFrame::Bone> bones(double at) {
    sample(clip_, rig_.rig().first_frame() + at / clip_.frame_time, pose_.pose(0));
    BodyPose body;
    rig_.read(pose_.pose(0), body);
    std::array<Quat, kHumanJoints> world;
    canonical_frames(body.positions, body.facing, world);
    std::vector<VmcFrame::Bone> out = {{kVmcRoot, {}, {}}};
    for (int j = 0; j < kHumanJoints; ++j) {
      const int parent = kHumanParent[j];
      if (parent < 0) {
        out.push_back({bones_[j], body.positions[j], world[j]});
      } else {
        out.push_back({bones_[j], skeleton_.joints[static_cast<size_t>(j)].offset,
                       normalized(conjugate(world[parent]) * world[j])});
      }
    }
    return out;
  }

 private:
  const Clip& clip_;
  PosedRig rig_;
  Clip pose_;  // One frame.
  Skeleton skeleton_ = canonical_skeleton();
  std::array<int, kHumanJoints> bones_;  // See vmc_bones.h.
};

Result<void> check(const SendOptions& options) {
  auto good = check_range("--fps", options.fps.value_or(1), 1, 1000);
  if (good) good = check_range("--seconds", options.seconds.value_or(1), 0.1, 1e6);
  return good ? check_rig_flags(options.rig) : good;
}

// Returns how many frames were sent before the end or Ctrl-C.
int64_t play(Player& player, double fps, const SendOptions& options, UdpSocket& socket,
             const sockaddr_in& to) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  const double motion = player.duration();
  constexpr double kRounding = 1e-3;  // Frames; files round their frame times.
  double count = std::numeric_limits<double>::infinity();
  if (!options.loop) count = std::floor(motion * fps + kRounding) + 1;  // Includes the last frame.
  if (options.seconds) count = std::min(count, std::ceil(*options.seconds * fps - kRounding));
  for (int64_t frame = 0;; ++frame) {
    if (static_cast<double>(frame) >= count) return frame;
    const double at = static_cast<double>(frame) / fps;
    // A motion with a single pose cannot loop.
    const double in_motion = options.loop && motion > 0 ? std::fmod(at, motion) : at;
    std::this_thread::sleep_until(
        begin + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(at)));
    if (stop_asked()) return frame;
    for (const std::vector<char>& bundle : format_vmc({at, player.bones(in_motion)})) {
      socket.send(bundle, to);  // Nobody may be listening, so failures are ignored.
    }
  }
}

int send(const SendOptions& options) {
  need(check(options), kBadUsage);
  const sockaddr_in to = need(parse_address(options.to, "--to"), kBadUsage);
  const RigOptions rig_options = need(read_rig_options(options.rig));
  const std::unique_ptr<MotionFile> motion = need(open_motion(options.input));
  std::vector<std::string> notes = motion->notes();
  const std::vector<int> picked =
      need(pick_clips(*motion, options.clip, rig_options, options.input, notes));
  print_notes(notes);
  const Clip& clip = motion->clip(picked.front());
  Player player(clip, need(make_rig(clip, rig_options, options.input)));
  UdpSocket socket = need(UdpSocket::open());

  watch_stop_signals();
  const double fps = options.fps.value_or(1 / clip.frame_time);
  const int64_t frames = play(player, fps, options, socket, to);
  print("sent " + plural(static_cast<size_t>(frames), "frame") + " (" +
        fixed(static_cast<double>(frames) / fps, 1) + " s) to " + to_string(to) + "\n");
  return kDone;
}

}  // namespace

std::function<int()> add_send(CLI::App& live) {
  CLI::App* verb = live.add_subcommand("send", "Play a file as a tracker (VMC protocol)");
  auto options = std::make_shared<SendOptions>();
  verb->add_option("FILE", options->input, "Motion file")->required();
  add_option(*verb, "--to ADDRESS", options->to,
             "Receiver: PORT on this machine or HOST:PORT;\ndefault: 39539");
  add_option(*verb, "--fps N", options->fps, "Frames a second; default: the file's");
  add_option(*verb, "--seconds SECONDS", options->seconds, "Stop after this time");
  verb->add_flag("--loop", options->loop, "Repeat from the start");
  add_option(*verb, "--clip NAME", options->clip,
             "Motion to play, if a file has several;\ndefault: the first");
  add_rig_options(*verb, options->rig);
  verb->footer("Example:\n  panache live send walk.bvh --to 127.0.0.1:39539 --fps 90 --loop");
  return [options] { return send(*options); };
}

}  // namespace panache::cli

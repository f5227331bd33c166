// panache live and panache live send, fed and heard by sockets of the test.

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/random.h"
#include "cli/program.h"
#include "cli/vmc_peer.h"
#include "clip/clip.h"
#include "clip/motion_file.h"

namespace panache::test {
namespace {

// How far the head is ahead of the hips, mean over the last `count` frames, of a walk along +z.
float lean(const std::vector<Bytes>& datagrams, int count) {
  std::map<std::string, Bone> now;
  std::vector<float> all;
  for (const Bytes& datagram : datagrams) {
    for (const auto& [name, bone] : bones_of(datagram)) {
      if (name == "Hips" && now.contains("Head")) {
        Quat rotation;
        Vec3 position;
        for (const char* joint : {"Hips", "Spine", "Chest", "Neck", "Head"}) {
          position += rotate(rotation, now[joint].position);
          rotation = rotation * now[joint].rotation;
        }
        all.push_back((position - now["Hips"].position).z);
      }
      now[name] = bone;
    }
  }
  EXPECT_GE(all.size(), static_cast<size_t>(count));
  float sum = 0;
  for (size_t i = all.size() - static_cast<size_t>(count); i < all.size(); ++i) sum += all[i];
  return sum / static_cast<float>(count);
}

// The last state of each bone. A frame takes several datagrams.
std::map<std::string, Bone> last_of(const std::vector<Bytes>& datagrams) {
  std::map<std::string, Bone> last;
  for (const Bytes& datagram : datagrams) {
    for (const auto& [name, bone] : bones_of(datagram)) last[name] = bone;
  }
  return last;
}

class LiveVerb : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    if (run("live --help").out.find("not in this build") != std::string::npos) {
      GTEST_SKIP() << "this build has no liblo";
    }
    Peer free;
    in_ = free.port();
  }
  void TearDown() override {
    for (const pid_t child : children_) {
      ::kill(child, SIGKILL);
      ::waitpid(child, nullptr, 0);
    }
    ProgramTest::TearDown();
  }

  // Starts the program, its output going to NAME.out and NAME.err; without `model` it takes the one
  // that is shipped.
  pid_t start(const std::string& name, const Words& arguments,
              const std::string& model = "model.safetensors") {
    children_.push_back(ProgramTest::start(arguments, model, PANACHE_PROGRAM, "/dev/null", name));
    return children_.back();
  }

  // Starts the relay from in_ to `sink` and waits until it listens.
  void start_live(Words arguments, const std::string& model = "model.safetensors",
                  const std::string& host = "") {
    arguments.insert(arguments.begin(), {"live", "--vmc-in", host + std::to_string(in_),
                                         "--vmc-out", "127.0.0.1:" + sink_.port_name()});
    live_ = start("live", arguments, model);
    for (int i = 0; i < kPatience && !exists("live.err"); ++i) nap(5);
    for (int i = 0; i < kPatience && read("live.err").find("relaying") == std::string::npos; ++i)
      nap(5);
    ASSERT_TRUE(holds(read("live.err"), "relaying"));
  }

  Ran end(pid_t child, int signal) {
    if (signal) ::kill(child, signal);
    std::erase(children_, child);
    return finish(child, child == live_ ? "live" : "send");
  }
  Ran end_live(int signal = SIGINT) { return end(live_, signal); }

  // Plays walk.bvh for so long through `change` to the relay, and collects what went in and what
  // came out.
  using Change = std::function<std::vector<Bytes>(const Bytes&)>;
  void play(
      double seconds, const Change& change = [](const Bytes& b) { return std::vector{b}; }) {
    Peer tracker;
    const pid_t sender = start("send", {"live", "send", "walk.bvh", "--to", tracker.port_name(),
                                        "--loop", "--seconds", std::to_string(seconds)});
    const size_t already = got_.size();
    size_t sent = 0;
    for (bool is_over = false;;) {
      const std::optional<Bytes> datagram = tracker.receive(is_over ? 0 : 20);
      if (!datagram) {
        if (is_over) break;
        siginfo_t ended{};  // What it sent before it ended is in the socket.
        is_over = ::waitid(P_PID, static_cast<id_t>(sender), &ended, WEXITED | WNOHANG | WNOWAIT) ||
                  ended.si_pid == sender;
        continue;
      }
      for (const Bytes& part : change(*datagram)) {
        tracker_.send(in_, part);
        sent_.push_back(part);
        ++sent;
      }
      collect(0);
    }
    EXPECT_EQ(end(sender, 0).exit, 0);
    collect_until(already + sent);
  }
  // The same with a walk that the relay makes old.
  void play_old(const Change& change) {
    must("walker -o walk.bvh --seconds 3");
    start_live("--style old=1", "");
    play(2.5, change);
    const Ran ran = end_live();
    EXPECT_EQ(ran.exit, 0) << ran.err;
    ASSERT_EQ(got_.size(), sent_.size());
  }
  // Until so many datagrams have come, and all that come right after them.
  void collect_until(size_t count) {
    for (int i = 0; i < kPatience && got_.size() < count; ++i) collect(5);
    collect(100);
  }
  void collect(int milliseconds) {
    while (std::optional<Bytes> datagram = sink_.receive(milliseconds)) got_.push_back(*datagram);
  }

  static void nap(int milliseconds) {
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
  }

  static constexpr int kPatience = 12000;  // Times 5 ms: what takes longer hangs.
  Peer tracker_, sink_;
  std::vector<Bytes> sent_, got_;
  uint16_t in_ = 0;
  pid_t live_ = -1;
  std::vector<pid_t> children_;
};

TEST_F(LiveVerb, send_plays_a_file_as_a_tracker_would) {
  write("walk.bvh", format_bvh(walking_clip(60, 60)));
  const pid_t sender =
      start("send", {"live", "send", "walk.bvh", "--to", sink_.port_name(), "--seconds", "0.2"});
  const Ran ran = end(sender, 0);
  EXPECT_EQ(ran.exit, 0) << ran.err;
  collect(500);  // The socket has kept it all.
  // 60 a second.
  EXPECT_EQ(ran.out, "sent 12 frames (0.2 s) to 127.0.0.1:" + sink_.port_name() + "\n");
  std::vector<std::map<std::string, Bone>> frames(1);
  int ends = 0;
  for (const Bytes& datagram : got_) {
    EXPECT_LT(datagram.size(), 1500u);  // A packet of most networks.
    frames.back().merge(bones_of(datagram));
    if (messages_of(datagram).back().starts_with("/VMC/Ext/T")) {
      ++ends;
      frames.emplace_back();
    }
  }
  ASSERT_EQ(ends, 12);
  EXPECT_EQ(frames[0].size(), 22u);                    // 21 joints and the root.
  EXPECT_LT(frames[0]["LeftUpperArm"].position.x, 0);  // Unity's left.
  // 1.2 m/s for 11 frame times, to a hundredth: the file has six decimals.
  EXPECT_NEAR(frames[11]["Hips"].position.z - frames[0]["Hips"].position.z, 0.22f, 0.0022f);
  // The arms hang, 1.4 of a quarter turn's 1.57 radians: in Unity the left one turns to +z.
  EXPECT_NEAR(frames[0]["LeftUpperArm"].rotation.z, std::sin(0.7f), 0.05f);
  EXPECT_NEAR(frames[0]["RightUpperArm"].rotation.z, -std::sin(0.7f), 0.05f);
}

TEST_F(LiveVerb, neutral_motion_and_other_messages_pass_byte_for_byte_until_a_style_is_set) {
  write("walk.bvh", format_bvh(walking_clip(60, 60)));
  start_live({});
  int count = 0;
  play(1.6, [&](const Bytes& datagram) {
    // Beside the bones, among them, and in a bundle in a bundle.
    std::vector<Bytes> messages = messages_of(datagram);
    messages.insert(messages.begin() + 3, blend_message(static_cast<float>(++count)));
    return std::vector{osc("/VMC/Ext/Blend/Apply") + osc(","), bundle(messages),
                       bundle({bundle({blend_message(0.5f)}), osc("/VMC/Ext/Hmd/Pos") + osc(",")})};
  });
  ASSERT_EQ(got_.size(), sent_.size());
  for (size_t i = 0; i < sent_.size(); ++i) ASSERT_EQ(got_[i], sent_[i]) << i;

  tracker_.send(in_, style_message("old", 1));
  sent_.clear();
  got_.clear();
  play(0.5);
  ASSERT_EQ(got_.size(), sent_.size());  // The message itself is not for the avatar.
  EXPECT_NE(bones_of(got_[got_.size() - 2])["Spine"].rotation,
            bones_of(sent_[sent_.size() - 2])["Spine"].rotation);
  EXPECT_EQ(bones_of(got_[got_.size() - 2])["Spine"].position,
            bones_of(sent_[sent_.size() - 2])["Spine"].position);
  const Ran ran = end_live();
  EXPECT_EQ(ran.exit, 0);
  EXPECT_TRUE(holds(ran.err, ", neutral\n"));
}

TEST_F(LiveVerb, an_old_walk_leans_forward_even_when_each_bone_comes_alone) {
  play_old(messages_of);
  // In the data old people walk with the head some 10 cm further ahead; half of it shows that it
  // is forward, and not the noise of the walk.
  EXPECT_GT(lean(got_, 60) - lean(sent_, 60), 0.05f);
}

// A datagram without the bones of legs.
std::vector<Bytes> upper_body(const Bytes& datagram) {
  std::vector<Bytes> kept;
  for (const Bytes& message : messages_of(datagram)) {
    const bool is_leg =
        std::ranges::any_of(std::array{"Leg", "Foot", "Toes"},
                            [&](const char* part) { return message.find(part) != Bytes::npos; });
    if (!is_leg) kept.push_back(message);
  }
  return kept;
}

TEST_F(LiveVerb, a_sender_without_legs_is_styled) {
  play_old(upper_body);
  EXPECT_GT(lean(got_, 60) - lean(sent_, 60), 0.05f);
}

// A datagram with all positions 0.
std::vector<Bytes> rotations_alone(const Bytes& datagram) {
  std::vector<Bytes> out = messages_of(datagram);
  for (Bytes& message : out) {
    if (!message.starts_with("/VMC/Ext/Bone/Pos")) continue;
    const size_t at = 32 + osc(Bytes(message.c_str() + 32)).size();
    message.replace(at, 12, 12, '\0');
  }
  return out;
}

TEST_F(LiveVerb, a_sender_that_gives_no_positions_is_styled_by_angles) {
  play_old(rotations_alone);
  std::map<std::string, Bone> in = last_of(sent_), out = last_of(got_);
  EXPECT_LT(std::abs(dot(in["Spine"].rotation, out["Spine"].rotation)), 0.999f);
  for (const auto& [name, bone] : out) {
    if (name == "Hips") continue;
    EXPECT_EQ(bone.position, in[name].position) << name;
  }
  // Old people stand lower.
  EXPECT_LT(out["Hips"].position.y, -0.01f);
  EXPECT_GT(out["Hips"].position.y, -0.3f);
}

TEST_F(LiveVerb, each_sender_moves_as_a_person) {
  must("walker -o walk.bvh --seconds 3");
  start_live("--person random --seed 4", "");
  play(2.5);
  const std::map<std::string, Bone> in = last_of(sent_), out = last_of(got_);
  EXPECT_LT(std::abs(dot(in.at("LeftUpperArm").rotation, out.at("LeftUpperArm").rotation)),
            0.9999f);
  const Ran ran = end_live();
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_TRUE(holds(ran.err, "sender 1 moves as person "));
}

TEST_F(LiveVerb, a_mirrored_walk_swings_the_other_leg) {
  write("walk.bvh", format_bvh(walking_clip(60, 60)));
  start_live("--mirror");
  play(1.5);
  const std::map<std::string, Bone> in = last_of(sent_), out = last_of(got_);
  for (const std::string bone : {"UpperLeg", "LowerArm", "Foot"}) {
    for (const auto& [side, other] : {std::pair("Left", "Right"), std::pair("Right", "Left")}) {
      const Quat q = in.at(side + bone).rotation, seen = out.at(other + bone).rotation;
      EXPECT_EQ(seen, (Quat{q.x, -q.y, -q.z, q.w})) << side << bone;
    }
  }
  EXPECT_EQ(out.at("Hips").position.x, -in.at("Hips").position.x);
  EXPECT_EQ(out.at("LeftFoot").position, in.at("LeftFoot").position);
  EXPECT_EQ(end_live().exit, 0);
}

TEST_F(LiveVerb, says_once_how_to_connect_and_once_that_nothing_comes_any_more) {
  const auto count = [&](const std::string& text) {
    const std::string err = read("live.err");
    size_t found = 0;
    for (size_t at = 0; (at = err.find(text, at)) != err.npos; ++at) ++found;
    return found;
  };
  write("walk.bvh", format_bvh(walking_clip(60, 60)));
  start_live({});
  const std::string hint = "no motion comes in yet: let the tracker send VMC";
  for (int i = 0; i < kPatience && count(hint) == 0; ++i) nap(5);
  nap(1500);
  EXPECT_EQ(count(hint), 1u);
  EXPECT_TRUE(
      holds(read("live.err"), "'panache live send walk.bvh --to " + std::to_string(in_) + "'"));
  play(0.3);
  for (int i = 0; i < kPatience && count("no motion comes in any more") == 0; ++i) nap(5);
  nap(1200);
  EXPECT_EQ(count("no motion comes in any more"), 1u);
  EXPECT_GE(count(" frames of 1 sender"), 1u);
  EXPECT_EQ(count(hint), 1u);
  EXPECT_EQ(end_live().exit, 0);
}

TEST_F(LiveVerb, sigterm_ends_it_with_a_recording_of_all_frames) {
  write("walk.bvh", format_bvh(walking_clip(60, 60)));
  start_live("--record take.bvh");
  play(1.5);
  const Ran ran = end_live(SIGTERM);
  EXPECT_EQ(ran.exit, 0) << ran.err;
  // 60 a second; a stall of this machine between the datagrams of one makes two of it.
  int relayed = 0;
  ASSERT_EQ(std::sscanf(ran.out.c_str(), "relayed %d frames of 1 sender in ", &relayed), 1)
      << ran.out;
  EXPECT_GE(relayed, 90);
  EXPECT_LE(relayed, static_cast<int>(sent_.size()));
  EXPECT_TRUE(holds(ran.out, "\nrecorded " + std::to_string(relayed) + " frames ("));
  const auto file = read_motion(path("take.bvh"));
  ASSERT_TRUE(file.ok()) << file.error().message;
  const Clip& clip = (*file)->clip();
  ASSERT_EQ(clip.frames, relayed);
  std::vector<Quat> rotations(clip.joints());
  std::vector<Vec3> positions(clip.joints());
  world_pose(clip.skeleton, clip.pose(0), {rotations, positions});
  for (size_t j = 0; j < clip.joints(); ++j) {
    const std::string& name = clip.skeleton.joints[j].name;
    if (name.starts_with("LeftHand")) {
      EXPECT_GT(positions[j].x, 0);
    } else if (name.starts_with("RightHand")) {
      EXPECT_LT(positions[j].x, 0);
    }
  }
}

TEST_F(LiveVerb, each_sender_has_a_character_of_its_own) {
  start_live({});
  const Peer others[2];
  // Sent by one, the second of these would repeat a bone and end a frame.
  for (int i = 0; i < 5; ++i) {
    for (const Peer* peer : {&std::as_const(tracker_), &others[0], &others[1]}) {
      peer->send(in_, bundle({bone_message("Hips")}));
    }
  }
  collect_until(15);
  EXPECT_EQ(got_.size(), 15u);
  const Ran ran = end_live();
  EXPECT_EQ(ran.out.find("relayed 15 frames of 3 senders in "), 0u) << ran.out;
}

TEST_F(LiveVerb, what_waits_of_a_sender_is_sent_when_it_makes_room_for_another) {
  write("walk.bvh", format_bvh(walking_clip(60, 60)));
  start_live({});
  play(1.3);  // From now on frames wait until they are whole.
  got_.clear();
  const Peer others[16];
  const Bytes begun = bundle({bone_message("Hips", 0.5f)});
  tracker_.send(in_, begun);
  // All in less than the 20 ms after which it would be sent anyway.
  for (const Peer& other : others) other.send(in_, bundle({bone_message("Head")}));
  collect_until(17);
  EXPECT_EQ(std::count(got_.begin(), got_.end(), begun), 1);
  EXPECT_EQ(got_.size(), 17u);
}

TEST_F(LiveVerb, a_message_changes_the_side_of_a_style) {
  write("walk.bvh", format_bvh(walking_clip(60, 60)));
  // The mean of both sides holds the head in the middle.
  const auto sideways = [&](const Words& options, const Bytes& message) {
    start_live(options);
    tracker_.send(in_, message);
    play(2.5);
    float sum = 0;
    size_t count = 0;
    for (const Bytes& datagram : got_) {
      for (const auto& [name, bone] : bones_of(datagram)) {
        if (name == "Chest") sum += bone.rotation.z, ++count;
      }
    }
    got_.clear();
    EXPECT_GT(count, 60u);
    EXPECT_EQ(end_live().exit, 0);
    return sum / static_cast<float>(count);
  };
  const Bytes none = style_message("sad", 0);
  const float captured = sideways("--style old=1", none);
  ASSERT_GT(std::abs(captured), 0.005f);
  const float mirrored = sideways("--style old=1 --side old=mirrored", none);
  EXPECT_LT(mirrored / captured, 0);
  const Bytes word = osc("/panache/side") + osc(",ss") + osc("old") + osc("mirrored");
  EXPECT_NEAR(sideways("--style old=1", word), mirrored, 0.2f * std::abs(mirrored));
  const Bytes number = osc("/panache/side") + osc(",sf") + osc("old") + osc(-1.0f);
  EXPECT_NEAR(sideways("--style old=1", number), mirrored, 0.2f * std::abs(mirrored));
}

TEST_F(LiveVerb, garbage_does_not_end_it) {
  write("walk.bvh", format_bvh(walking_clip(60, 60)));
  start_live("--style old=1");
  play(1.3);
  ASSERT_FALSE(sent_.empty());
  const Bytes good = sent_.back();
  Random random(7);
  const auto throw_at = [&](const Bytes& bytes) {
    tracker_.send(in_, bytes);
    collect(0);
  };
  for (size_t size = 0; size < good.size(); ++size) throw_at(good.substr(0, size));
  for (size_t i = 0; i < good.size(); ++i) {
    Bytes changed = good;
    changed[i] = static_cast<char>(changed[i] ^ (1 << random.below(8)));
    throw_at(changed);
  }
  for (int i = 0; i < 300; ++i) {
    Bytes noise(random.below(2000), '\0');
    for (char& c : noise) c = static_cast<char>(random.below(256));
    throw_at(noise);
    throw_at("/" + noise);
    throw_at("#bundle" + Bytes(1, '\0') + noise);
  }
  throw_at(Bytes(65507, '/'));
  Bytes nested = blend_message(1);
  for (int i = 0; i < 1000; ++i) nested = bundle({nested});
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  for (const Bytes& message :
       {osc("/VMC/Ext/Bone/Pos") + osc(",fs") + osc(1.0f) + osc("Hips"),
        osc("/VMC/Ext/Bone/Pos") + osc(",sfffffff") + osc("Hips"),
        osc("/panache/style") + osc(",ss") + osc("old") + osc("1"), style_message("nobody", 1),
        osc("/panache/side") + osc(",ss") + osc("old") + osc("up"),
        osc("/panache/side") + osc(",ss") + osc("nobody") + osc("left"),
        osc("/panache/side") + osc(",s") + osc("old"), style_message("old", kNan),
        bundle({bone_message("Hips", kNan, 1e38f, kNan), bone_message("Head", 0, 0, 0)})}) {
    throw_at(message);
  }
  // All of it is through when this is: a sender's datagrams keep their order.
  const Bytes last = blend_message(0.75f);
  tracker_.send(in_, last);
  for (int i = 0; i < kPatience && (got_.empty() || got_.back() != last); ++i) collect(5);
  got_.clear();

  // Bundles are opened, but not without end.
  tracker_.send(in_, nested);
  // A frame that stays incomplete goes out all the same, and in finite numbers.
  tracker_.send(in_, bundle({bone_message("Hips", kNan, 1e38f, kNan)}));
  tracker_.send(in_, blend_message(0.25f));
  collect_until(2);
  ASSERT_EQ(got_.size(), 2u);
  EXPECT_TRUE(is_finite(bones_of(got_[0])["Hips"].position));
  EXPECT_TRUE(is_finite(bones_of(got_[0])["Hips"].rotation));
  EXPECT_EQ(got_[1], blend_message(0.25f));
  const Ran ran = end_live();
  EXPECT_EQ(ran.exit, 0);
  EXPECT_FALSE(holds(ran.out, " 0 rejected"));
}

TEST_F(LiveVerb, listens_where_it_is_told) {
  start_live({});
  tracker_.send(in_, blend_message(1), 2);  // 127.0.0.2 is this machine too.
  tracker_.send(in_, blend_message(2), 1);
  collect_until(2);
  EXPECT_EQ(got_, (std::vector<Bytes>{blend_message(1), blend_message(2)}));
  EXPECT_EQ(end_live().exit, 0);

  got_.clear();
  start_live({}, "model.safetensors", "127.0.0.1:");
  tracker_.send(in_, blend_message(3), 2);
  tracker_.send(in_, blend_message(4), 1);
  collect_until(1);
  EXPECT_EQ(got_, std::vector<Bytes>{blend_message(4)});
  EXPECT_EQ(end_live().exit, 0);
}

TEST_F(LiveVerb, sends_to_the_avatar_alone_whatever_it_receives) {
  write("walk.bvh", format_bvh(walking_clip(60, 60)));
  start_live("--style old=1");
  const Peer stranger;
  stranger.send(in_, "GET / HTTP/1.1\r\n\r\n");
  for (const std::string path : {"/VMC/Ext/Set/Res", "/VMC/Ext/Set/Req", "/ping", "/status"}) {
    stranger.send(in_, osc(path) + osc(",si") + osc("127.0.0.1") + osc(uint32_t{tracker_.port()}));
  }
  stranger.send(in_, style_message("nobody", 1));
  play(1.3);
  EXPECT_GT(got_.size(), 100u);
  EXPECT_EQ(stranger.receive(0), std::nullopt);
  EXPECT_EQ(tracker_.receive(0), std::nullopt);
  // No socket but the one.
  int sockets = 0;
  for (const auto& file :
       std::filesystem::directory_iterator("/proc/" + std::to_string(live_) + "/fd")) {
    std::error_code gone;
    sockets += std::filesystem::read_symlink(file, gone).string().starts_with("socket:");
  }
  EXPECT_EQ(sockets, 1);
  EXPECT_EQ(end_live().exit, 0);
}

TEST_F(LiveVerb, does_not_grow_in_a_flood_of_senders) {
  start_live("--style old=1");
  const auto resident_pages = [&] {
    long size = 0, resident = 0;
    EXPECT_EQ(std::sscanf(read_file("/proc/" + std::to_string(live_) + "/statm")->c_str(),
                          "%ld %ld", &size, &resident),
              2);
    return resident;
  };
  // More senders than it keeps, each beginning frames that stay incomplete.
  const Peer senders[40];
  const Bytes frame = bundle({bone_message("Hips"), bone_message("Head")});
  const Bytes filler = bundle(std::vector<Bytes>(200, blend_message(1)));
  size_t bytes = 0;  // That came through.
  const auto flood = [&](int rounds) {
    for (int i = 0; i < rounds; ++i) {
      for (size_t s = 0; s < std::size(senders); ++s) {
        senders[s].send(in_, frame);
        senders[s].send(in_, filler);
        senders[s].send(in_, style_message("nobody" + std::to_string(i), 1));
        senders[s].send(in_, "garbage");
        if (s % 5 != 0) continue;
        collect(2);  // Or most would find no room in the socket.
        for (const Bytes& datagram : got_) bytes += datagram.size();
        got_.clear();
      }
    }
  };
  flood(10);
  [[maybe_unused]] const long before = resident_pages();
  bytes = 0;
  // How much gets through at a time depends on the machine.
  for (int i = 0; i < 2000 && bytes <= 16u << 20; ++i) flood(8);
  ASSERT_GT(bytes, 16u << 20);
#ifndef PANACHE_SANITIZED  // The sanitizer keeps what is freed for a while.
  // Pages of 4 KB: what waits for its frame for 20 ms stays below 8 MB.
  EXPECT_LT(resident_pages() - before, 8 << 8);
#endif
  EXPECT_EQ(end_live().exit, 0);
}

TEST_F(LiveVerb, explains_a_wrong_wish_before_it_starts) {
  write("take.bvh", "mine");
  write_walk("walk.bvh");
  expect_rejected("live --record take.bvh", 1, "take.bvh: exists already; --force overwrites it");
  expect_rejected(
      {"live", "--vmc-in", sink_.port_name()}, 1,
      "--vmc-in: cannot listen at port " + sink_.port_name() + ": Address already in use");
  expect_rejected("live send none.bvh", 1, "none.bvh: cannot be read: No such file or directory");
  const std::pair<const char*, const char*> cases[] = {
      {"live --record take.glb", "--record take.glb: expected a name that ends in .bvh"},
      {"live --vmc-in 0", "--vmc-in: expected a port from 1 to 65535, found '0'"},
      {"live --vmc-out there:x", "--vmc-out: expected a port from 1 to 65535, found 'x'"},
      {"live --vmc-in 40000 --vmc-out 40000",
       "--vmc-out: expected another port than that of --vmc-in, found 40000 for both"},
      {"live --style old=1..0",
       "--style old=1..0: live motion has no end to change towards; expected one strength"},
      {"live send walk.bvh --fps 0", "--fps: expected a number from 1 to 1000, found 0"},
      {"live send", "FILE is required; see panache live send --help"},
      {"live send walk.bvh --loops",
       "there is no option '--loops'; the nearest is --loop; see panache live send --help"},
      {"live --style old=1 send walk.bvh",
       "--style: 'live send' has no such option; see panache live send --help"},
      {"live sned walk.bvh", "unexpected argument 'sned'; see panache live --help"},
  };
  for (const auto& [command, message] : cases) expect_rejected(command, 2, message);
}

}  // namespace
}  // namespace panache::test

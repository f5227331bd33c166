// A sender of the relay: datagrams at any times, of a body that glides, with any numbers in them or
// of any bytes. All of them come out again, once and in their order, changed in nothing but their
// bones, and without a style not in these; what was recorded is a BVH file that can be read.

#include <algorithm>

#include <fuzzer/FuzzedDataProvider.h>

#include "any_number.h"
#include "clip/bvh.h"
#include "use_motion.h"
#include "vmc_bones.h"
#include "vmc_character.h"
#include "vmc_messages.h"

namespace {

using namespace panache;
using fuzz::any_number;

// As a tracker sends a frame; a few of the numbers may be odd, and then `odd` is set.
std::vector<std::vector<char>> any_frame(FuzzedDataProvider& data, double seconds, bool& odd) {
  constexpr std::pair<const char*, Vec3> kBones[] = {{"Hips", {0, 0.95f, 0}},
                                                     {"Spine", {0, 0.15f, 0}},
                                                     {"Chest", {0, 0.15f, 0}},
                                                     {"Neck", {0, 0.22f, 0}},
                                                     {"Head", {0, 0.1f, 0}},
                                                     {"LeftUpperArm", {0.19f, 0.16f, 0}},
                                                     {"LeftLowerArm", {0.28f, 0, 0}},
                                                     {"LeftHand", {0.25f, 0, 0}},
                                                     {"RightUpperArm", {-0.19f, 0.16f, 0}},
                                                     {"RightLowerArm", {-0.28f, 0, 0}},
                                                     {"RightHand", {-0.25f, 0, 0}},
                                                     {"LeftUpperLeg", {0.09f, -0.04f, 0}},
                                                     {"LeftLowerLeg", {0, -0.42f, 0}},
                                                     {"LeftFoot", {0, -0.41f, 0}},
                                                     {"RightUpperLeg", {-0.09f, -0.04f, 0}},
                                                     {"RightLowerLeg", {0, -0.42f, 0}},
                                                     {"RightFoot", {0, -0.41f, 0}}};
  cli::VmcFrame frame{seconds, {{cli::kVmcRoot, {}, {}}}};
  for (const auto& [name, position] : kBones) {
    frame.bones.push_back({*cli::find_vmc_bone(name), position, {}});
  }
  frame.bones[1].position.z = static_cast<float>(seconds);
  for (int changes = data.ConsumeIntegralInRange(0, 3); changes > 0; --changes) {
    odd = true;
    auto& bone = frame.bones[data.ConsumeIntegralInRange<size_t>(0, frame.bones.size() - 1)];
    if (data.ConsumeBool()) {
      bone.position = {any_number(data), any_number(data), any_number(data)};
    } else if (data.ConsumeBool()) {
      bone.rotation = {any_number(data), any_number(data), any_number(data), any_number(data)};
    } else {
      bone.index = data.ConsumeIntegralInRange(0, cli::kVmcBones - 1);
    }
  }
  if (data.ConsumeBool()) frame.bones.resize(frame.bones.size() / 2);
  std::vector<std::vector<char>> datagrams = cli::format_vmc(frame);
  if (data.ConsumeBool()) datagrams.pop_back();  // With it goes the message that ends the frame.
  return datagrams;
}

// How much later the next frame comes: mostly as it should.
double any_step(FuzzedDataProvider& data) {
  constexpr double kSteps[] = {1 / 60.0, 1 / 60.0, 1 / 60.0, 0.5, 0, -0.1, 1e-9, 30};
  return data.PickValueInArray(kSteps);
}

class Sender {
 public:
  explicit Sender(FuzzedDataProvider& data)
      : is_styled_(data.ConsumeBool()),
        strengths_{is_styled_ ? 1.0f : 0.0f, 0},
        character_({.model = fuzz::small_model(),
                    .options = options(data),
                    .removed = -1,
                    .recording = &recording_}) {}

  // `odd`: its bones may be anything.
  void send(std::vector<char> bytes, double now, bool odd) {
    is_odd_ = is_odd_ || odd;
    const auto messages = cli::read_vmc(bytes);
    if (!messages) return;
    sent_.push_back(bytes);
    character_.take({std::move(bytes), {}, now}, *messages, strengths_);
    receive();
  }
  void reset() { character_.reset(); }
  void wait(double now) {
    character_.end_late_frame(now, strengths_);
    receive();
  }
  void finish() {
    character_.end_frame(strengths_);
    receive();
    if (received_ != sent_.size()) fuzz::fail("a datagram was lost");
    static_cast<void>(character_.take_note());
    if (recording_.frames() == 0) return;
    const Clip clip = recording_.clip();
    const auto file = parse_bvh(format_bvh(clip), "recording.bvh");
    if (!file) fuzz::fail("what was recorded cannot be read: " + file.error().message);
    if ((*file)->clip().frames != clip.frames) fuzz::fail("another number of frames");
  }

 private:
  LiveOptions options(FuzzedDataProvider& data) {
    LiveOptions out;
    is_late_ = data.ConsumeBool();
    if (is_late_) out.max_lag = 0.5;
    return out;
  }
  // The datagram with zeros for the numbers of its bones.
  static std::vector<char> without_numbers(std::vector<char> bytes) {
    const auto messages = cli::read_vmc(bytes);
    if (!messages) fuzz::fail("what came back is no VMC");
    for (const cli::VmcMessage& message : *messages) {
      if (message.kind == cli::VmcMessage::bone) {
        std::fill_n(bytes.begin() + static_cast<ptrdiff_t>(message.offset), 28, '\0');
      }
    }
    return bytes;
  }
  void receive() {
    for (const cli::Datagram& datagram : character_.take_ready()) {
      if (received_ == sent_.size()) fuzz::fail("a datagram came twice");
      const std::vector<char>& sent = sent_[received_++];
      if (!is_styled_ && !is_late_ && !is_odd_ && datagram.bytes != sent) {
        fuzz::fail("a datagram is changed without a style");
      }
      if (without_numbers(datagram.bytes) != without_numbers(sent)) fuzz::fail("another datagram");
    }
  }

  bool is_styled_, is_late_ = false, is_odd_ = false;
  std::vector<float> strengths_;
  cli::VmcRecording recording_;
  cli::VmcCharacter character_;
  std::vector<std::vector<char>> sent_;
  size_t received_ = 0;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
  FuzzedDataProvider data(bytes, size);
  Sender sender(data);
  double now = 100;
  for (int call = 0; call < 200 && data.remaining_bytes() > 0; ++call) {
    switch (data.ConsumeIntegralInRange(0, 9)) {
      case 0:
        sender.reset();
        break;
      case 1:
        sender.wait(now + any_step(data));
        break;
      case 2: {
        const std::string any = data.ConsumeRandomLengthString(200);
        sender.send({any.begin(), any.end()}, now, true);
        break;
      }
      default: {
        bool odd = false;
        for (std::vector<char>& datagram : any_frame(data, now, odd)) {
          sender.send(std::move(datagram), now, odd);
        }
        now += any_step(data);
      }
    }
  }
  sender.finish();
  return 0;
}

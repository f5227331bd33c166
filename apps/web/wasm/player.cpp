#include "player.h"

#include <algorithm>

#include "clip/bvh.h"
#include "clip/clip.h"
#include "clip/gltf.h"
#include "retarget/reference_pose.h"
#include "retarget/retarget.h"
#include "rig/body_mesh.h"
#include "rig/figures.h"
#include "style/play/removal.h"

namespace panache::web {
namespace {

constexpr double kLongestStep = 0.1;  // Seconds; avoids a jump after the page was hidden.
constexpr double kRecordedSeconds = 20;
constexpr double kRecordedFps = 60;
constexpr const char* kName = "styled";  // Name of the motion in a new file.

// Like `panache convert`: the body has the rig's arm and leg lengths.
Result<std::string> vrma_of(const Clip& clip, const Rig& rig) {
  const Clip body = t_pose_body(clip, rig);
  const Result<Rig> onto = Rig::create(body);
  if (!onto) return onto.error();
  const Result<Retargeted> done = retarget(clip, rig, body, *onto, {.feet = false, .hands = false});
  if (!done) return done.error();
  return format_vrma(done->clip, kName);
}

// The bytes of a new file: BVH for ".bvh", the motion on the VRMA body for ".vrma", else GLB with a
// body. Fails if the motion cannot be retargeted.
Result<std::string> format_clip(const Clip& clip, const Source& source,
                                const std::string& extension) {
  const Rig& rig = source.rig();
  if (extension == ".vrma") return vrma_of(clip, rig);
  if (extension != ".bvh") {
    const Quat to_y_up = turn_up(rig.up_axis()).value_or(Quat{});
    const SkinnedBody body = make_rig_body(rig, source.reference());
    return format_glb(clip, kName, static_cast<double>(rig.unit()), to_y_up, &body);
  }
  Clip out = in_rest_axes(clip);
  add_end_sites(out.skeleton);
  return format_bvh(out);
}

}  // namespace

Shown::Shown(const Source& source)
    : rotations(source.clip().joints()),
      translations(source.clip().joints()),
      mannequin(source.rig(), source.reference()) {
  if (!source.file()) recording.emplace(source.clip().skeleton, kRecordedSeconds);
}

void Shown::update(double seconds) {
  numbers.clear();
  for (size_t j = 0; j < rotations.size(); ++j) {
    const Quat q = rotations[j];
    const Vec3 t = translations[j];
    numbers.insert(numbers.end(), {q.x, q.y, q.z, q.w, t.x, t.y, t.z});
  }
  mannequin.read(pose(), parts);
  if (recording) recording->add(pose(), seconds);
}

Result<std::unique_ptr<Player>> Player::create(std::shared_ptr<const Model> model, Source source) {
  std::unique_ptr<Player> player(new Player(std::move(source)));
  if (model) {
    if (auto used = player->use_model(std::move(model)); !used) return used.error();
  }
  player->step(0);
  return player;
}

Player::Player(Source source) : source_(std::move(source)), input_(source_), output_(source_) {}

void Player::set_track(int style, std::vector<StrengthTrack::Point> points) {
  tracks_[static_cast<size_t>(style)] = {style, std::move(points)};
}

void Player::set_gesture_rate(float rate) {
  gesture_rate_ = rate;
  if (character_) stylizer().set_gesture_rate(rate);
}

StylizerOptions Player::options() const {
  StylizerOptions options;
  options.tempo_everywhere = timing_ == Timing::all;
  options.gesture_rate = gesture_rate_;
  if (!character_) return options;
  options.sides = stylizer().sides();
  options.person = stylizer().person();
  options.shape = stylizer().shape();
  return options;
}

void Player::set_timing(Timing timing) {
  timing_ = timing;
  if (character_) stylizer().set_tempo_everywhere(timing == Timing::all);
  if (removal_) removal_->set_tempo_everywhere(timing == Timing::all);
}

Result<void> Player::use_remover(std::shared_ptr<const Model> remover) {
  if (remover == remover_) return {};
  Result<RemovalPass> removal = RemovalPass::create(remover, source_.rig(), options());
  if (!removal) return removal.error();
  remover_ = std::move(remover);
  removal_ = *std::move(removal);
  removed_ = -1;
  return {};
}

void Player::set_removed(int style) {
  if (!removal_ || style >= static_cast<int>(remover_->styles().size())) return;
  removed_ = std::max(style, -1);
  removal_->set_removed(removed_);
}

float Player::gate() const {
  const float gate = character_ ? stylizer().gate() : 1;
  return removed_ < 0 ? gate : std::min(gate, removal_->stylizer().gate());
}

Result<void> Player::use_model(std::shared_ptr<const Model> model) {
  LiveOptions live_options;
  live_options.stylizer = options();
  live_options.stylizer.sides = {};
  live_options.stylizer.person = {};
  Result<LiveStylizer> live = LiveStylizer::create(model, source_.rig(), live_options);
  if (!live) return live.error();
  model_ = std::move(model);
  strengths_now_.assign(model_->styles().size(), 0);
  tracks_.assign(strengths_now_.size(), {});
  character_.reset(new panache_character{*std::move(live), strengths_now_});
  rate_ = 1;
  return {};
}

std::vector<StrengthTrack> Player::file_tracks() const {
  std::vector<StrengthTrack> out;
  const std::vector<float>& strengths = character_->strengths;
  for (size_t s = 0; s < strengths.size(); ++s) {
    StrengthTrack track{static_cast<int>(s), {{0, strengths[s]}}};
    if (!tracks_[s].points.empty()) {
      track.points = tracks_[s].points;
      for (StrengthTrack::Point& point : track.points) point.seconds += source_.begin();
    } else if (strengths[s] == 0) {
      continue;
    }
    out.push_back(std::move(track));
  }
  return out;
}

void Player::read_strengths() {
  strengths_now_ = character_->strengths;
  for (size_t s = 0; s < tracks_.size(); ++s) {
    if (!tracks_[s].points.empty()) strengths_now_[s] = tracks_[s].at(source_.seconds());
  }
}

void Player::step(double seconds) {
  seconds = std::clamp(seconds, 0.0, kLongestStep);
  const double neutral_seconds = seconds * rate_, input_seconds = neutral_seconds * removal_rate_;
  if (source_.advance(input_seconds, input_.pose())) {
    if (character_) character_->live.reset();
    if (removal_) removal_->reset();
  }
  ConstPose in = input_.pose();
  if (removal_) in = removal_->step(in, input_seconds, neutral_seconds);
  const bool timed = timing_ != Timing::off;
  if (character_) {
    read_strengths();
    stylizer().step(in, strengths_now_, {neutral_seconds, seconds, source_.flight()},
                    output_.pose());
  } else {
    std::ranges::copy(in.rotations, output_.rotations.begin());
    std::ranges::copy(in.translations, output_.translations.begin());
  }
  rate_ = timed && character_ ? stylizer().rate() : 1;
  removal_rate_ = timed && removal_ ? removal_->stylizer().rate() : 1;
  input_.update(seconds);
  output_.update(seconds);
}

void Player::measure(int count) {
  constexpr double kSeconds = 1.0 / 60;
  if (!character_) return;
  Stylizer twin = stylizer();
  std::optional<RemovalPass> removal_twin = removal_;
  for (int i = 0; i < count; ++i) {
    ConstPose in = input_.pose();
    if (removal_twin) in = removal_twin->step(in, kSeconds, kSeconds);
    twin.step(in, strengths_now_, kSeconds, output_.pose());  // update() has already read it.
  }
}

const BodyMesh& Player::body(BodyDetail detail) {
  std::optional<BodyMesh>& body = detail == BodyDetail::fine ? body_ : coarse_body_;
  if (!body) {
    body = make_body_mesh(input_.mannequin.offsets(), moving_joints(source_.rig()), detail);
  }
  return *body;
}

Placement Player::placement() const {
  const Rig& rig = source_.rig();
  return {turn_up(rig.up_axis()).value_or(Quat{}), rig.scale(), rig.floor()};
}

Result<std::string> Player::export_as(const std::string& extension,
                                      const std::string& file_extension, bool styled,
                                      double seconds) const {
  const Clip& clip = source_.clip();
  const Rig& rig = source_.rig();
  if (const auto& recording = shown(styled).recording) {
    const Clip walk = recording->clip(kRecordedFps, std::min(seconds, kRecordedSeconds));
    return format_clip(walk, source_, extension);
  }
  if (!character_) return Error{"expected a model to export the motion with"};
  RestyleOptions restyle_options;
  restyle_options.stylizer = options();
  if (!styled) restyle_options.stylizer.shape = {};
  restyle_options.timing = timing_ != Timing::off;
  const auto tracks = styled ? file_tracks() : std::vector<StrengthTrack>();
  Result<Restyled> restyled =
      styled && removed_ >= 0
          ? restyle_without(clip, rig, {remover_, removed_}, model_, tracks, restyle_options)
          : restyle(clip, rig, model_, tracks, restyle_options);
  if (!restyled) return restyled.error();
  if (extension != file_extension) return format_clip(restyled->clip, source_, extension);
  const ClipEdit edit = {source_.which(), &restyled->clip, restyled->source_frames, kName};
  return source_.file()->encode({&edit, 1}, EditMode::replace);
}

}  // namespace panache::web

#include "player.h"

#include <algorithm>
#include <cstddef>

#include "format_clip.h"
#include "rig/rig_body.h"
#include "rig/up_axis.h"
#include "style/removal.h"
#include "style/restyle.h"

namespace panache::web {
namespace {

constexpr double kLongestStep = 0.1;  // Seconds; a page that was hidden does not jump.
constexpr double kRecordedSeconds = 20;
constexpr double kRecordedFps = 60;
constexpr size_t kJointNumbers = 7;

void put_numbers(ConstPose pose, std::vector<float>& out) {
  for (size_t j = 0; j < pose.rotations.size(); ++j) {
    const Quat q = pose.rotations[j];
    const Vec3 t = pose.translations[j];
    const float numbers[kJointNumbers] = {q.x, q.y, q.z, q.w, t.x, t.y, t.z};
    std::copy_n(numbers, kJointNumbers, out.begin() + static_cast<ptrdiff_t>(kJointNumbers * j));
  }
}

// Puts another stylizer or pass of the same model and rig in the place of one, with its memory.
template <class Pass>
void replace(Pass& one, Pass other) {
  std::vector<std::byte> state(one.state_size());
  one.save(state);
  one = std::move(other);
  one.restore(state);
}

}  // namespace

Result<std::unique_ptr<Player>> Player::create(std::shared_ptr<const Model> model,
                                               std::unique_ptr<Source> source) {
  Result<Stylizer> stylizer = Stylizer::create(model, source->rig());
  if (!stylizer) return stylizer.error();
  return std::unique_ptr<Player>(
      new Player(std::move(model), *std::move(stylizer), std::move(source)));
}

Player::Player(std::shared_ptr<const Model> model, Stylizer stylizer,
               std::unique_ptr<Source> source)
    : model_(std::move(model)),
      source_(std::move(source)),
      stylizer_(std::move(stylizer)),
      twin_(stylizer_),
      in_mannequin_(source_->rig(), source_->reference()),
      out_mannequin_(in_mannequin_),
      input_recording_(source_->clip().skeleton, kRecordedSeconds),
      recording_(input_recording_),
      strengths_(model_->styles().size()),
      strengths_now_(strengths_.size()),
      tracks_(strengths_.size()) {
  const size_t joints = source_->clip().joints();
  for (auto* rotations : {&in_rotations_, &out_rotations_, &twin_rotations_}) {
    rotations->resize(joints);
  }
  for (auto* translations : {&in_translations_, &out_translations_, &twin_translations_}) {
    translations->resize(joints);
  }
  in_numbers_.resize(kJointNumbers * joints);
  out_numbers_.resize(kJointNumbers * joints);
  step(0);
}

void Player::set_track(int style, std::vector<StrengthTrack::Point> points) {
  tracks_[static_cast<size_t>(style)] = {style, std::move(points)};
}

StylizerOptions Player::options() const {
  StylizerOptions options;
  options.tempo_everywhere = timing_ == Timing::all;
  return options;
}

void Player::set_timing(Timing timing) {
  if (timing == timing_) return;
  timing_ = timing;
  // The same models and rig as before, which suit each other.
  replace(stylizer_, *Stylizer::create(model_, source_->rig(), options()));
  if (!removal_) return;
  replace(*removal_, *RemovalPass::create(remover_, source_->rig(), options()));
  removal_->set_removed(removed_);
}

Result<void> Player::use_remover(std::shared_ptr<const Model> remover) {
  if (remover == remover_) return {};
  Result<RemovalPass> removal = RemovalPass::create(remover, source_->rig(), options());
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
  return removed_ < 0 ? stylizer_.gate() : std::min(stylizer_.gate(), removal_->stylizer().gate());
}

Result<void> Player::use_model(std::shared_ptr<const Model> model) {
  Result<Stylizer> stylizer = Stylizer::create(model, source_->rig(), options());
  if (!stylizer) return stylizer.error();
  model_ = std::move(model);
  stylizer_ = *std::move(stylizer);
  strengths_.assign(model_->styles().size(), 0);
  strengths_now_ = strengths_;
  tracks_.assign(strengths_.size(), {});
  rate_ = 1;
  return {};
}

std::vector<StrengthTrack> Player::file_tracks() const {
  std::vector<StrengthTrack> out;
  const auto* clip = dynamic_cast<const ClipSource*>(source_.get());
  for (size_t s = 0; s < strengths_.size(); ++s) {
    StrengthTrack track{static_cast<int>(s), {{0, strengths_[s]}}};
    if (clip && !tracks_[s].points.empty()) {
      track.points = tracks_[s].points;
      for (StrengthTrack::Point& point : track.points) point.seconds += clip->begin();
    } else if (strengths_[s] == 0) {
      continue;
    }
    out.push_back(std::move(track));
  }
  return out;
}

void Player::read_strengths() {
  strengths_now_ = strengths_;
  const auto* clip = dynamic_cast<const ClipSource*>(source_.get());
  if (!clip) return;
  for (size_t s = 0; s < strengths_.size(); ++s) {
    if (!tracks_[s].points.empty()) strengths_now_[s] = tracks_[s].at(clip->seconds());
  }
}

void Player::step(double seconds) {
  seconds = std::clamp(seconds, 0.0, kLongestStep);
  const double neutral_seconds = seconds * rate_, input_seconds = neutral_seconds * removal_rate_;
  if (source_->advance(input_seconds, {in_rotations_, in_translations_})) {
    stylizer_.reset();
    if (removal_) removal_->reset();
  }
  ConstPose in = input();
  if (removal_) in = removal_->step(in, input_seconds, neutral_seconds);
  const Pose out = {out_rotations_, out_translations_};
  stylizer_.set_shape(shape_);
  read_strengths();
  stylizer_.step(in, strengths_now_, {neutral_seconds, seconds, source_->flight()}, out);
  if (timing_ == Timing::off) {
    rate_ = removal_rate_ = 1;
  } else {
    rate_ = stylizer_.rate();
    removal_rate_ = removal_ ? removal_->stylizer().rate() : 1;
  }
  put_numbers(input(), in_numbers_);
  put_numbers(out, out_numbers_);
  in_mannequin_.read(input(), in_parts_);
  out_mannequin_.read(out, out_parts_);
  if (!dynamic_cast<WalkerSource*>(source_.get())) return;
  input_recording_.add(input(), seconds);
  recording_.add(out, seconds);
}

void Player::measure(int count) {
  constexpr double kSeconds = 1.0 / 60;
  twin_ = stylizer_;
  removal_twin_ = removal_;
  for (int i = 0; i < count; ++i) {
    ConstPose in = input();
    if (removal_twin_) in = removal_twin_->step(in, kSeconds, kSeconds);
    twin_.step(in, strengths_now_, kSeconds, {twin_rotations_, twin_translations_});
  }
}

const BodyMesh& Player::body(BodyDetail detail) {
  std::optional<BodyMesh>& body = detail == BodyDetail::fine ? body_ : coarse_body_;
  if (!body) body = make_body_mesh(in_mannequin_.offsets(), moving_joints(source_->rig()), detail);
  return *body;
}

Placement Player::placement() const {
  const Rig& rig = source_->rig();
  return {turn_up(rig.up_axis()).value_or(Quat{}), rig.scale(), rig.floor()};
}

Result<std::string> Player::export_as(const std::string& extension,
                                      const std::string& file_extension, bool styled,
                                      double seconds) const {
  const auto* from_file = dynamic_cast<const ClipSource*>(source_.get());
  const auto written = [&](const Clip& motion) {
    return format_clip(motion, source_->rig(), source_->reference(), extension);
  };
  if (!from_file) {
    const Recording& recording = styled ? recording_ : input_recording_;
    return written(recording.clip(kRecordedFps, std::min(seconds, kRecordedSeconds)));
  }
  RestyleOptions how;
  how.stylizer = options();
  if (styled) how.stylizer.shape = shape_;
  how.timing = timing_ != Timing::off;
  const Clip& clip = source_->clip();
  const Rig& rig = source_->rig();
  const auto tracks = styled ? file_tracks() : std::vector<StrengthTrack>();
  Result<Restyled> restyled =
      styled && removed_ >= 0
          ? restyle_without(clip, rig, {remover_, removed_}, model_, tracks, how)
          : restyle(clip, rig, model_, tracks, how);
  if (!restyled) return restyled.error();
  if (extension != file_extension) return written(restyled->clip);
  const ClipEdit edit = {from_file->which(), &restyled->clip, restyled->source_frames, "styled"};
  return from_file->file().encode({&edit, 1}, EditMode::replace);
}

}  // namespace panache::web

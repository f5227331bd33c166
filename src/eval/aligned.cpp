#include "eval/aligned.h"

#include <algorithm>
#include <optional>

#include "base/parallel.h"
#include "learn/samples.h"

namespace panache {
namespace {

constexpr size_t kInstantsPerPart = 512;  // Of the work that one thread takes at a time.

std::vector<AlignedInstant> align(const std::vector<Take>& takes) {
  std::vector<int> styled, neutral;
  for (size_t i = 0; i < takes.size(); ++i) {
    (takes[i].row.neutral ? neutral : styled).push_back(static_cast<int>(i));
  }
  std::vector<AlignedInstant> instants;
  for (const Pairing& pairing : pair_takes(takes, styled, neutral)) {
    const int frames = static_cast<int>(pairing.neutral_frames.size());
    for (int i = kTrimFrames; i < frames - kTrimFrames; ++i) {
      instants.push_back(
          {pairing.styled, pairing.first + i, pairing.neutral, pairing.neutral_frames[i]});
    }
  }
  return instants;
}

// A model that goes through instants one after the other.
class Reader {
 public:
  Reader(const Model& model, double strength)
      // Nobody owns the model here: it outlives the reader.
      : networks_(std::shared_ptr<const Model>(std::shared_ptr<const Model>(), &model)),
        strength_(static_cast<float>(strength)),
        strengths_(model.styles().size()),
        numbers_(pose_numbers(model.layout())),
        window_(size_t(kWindowPoses) * numbers_) {}

  // The change that it makes of frame `at` of `neutral`, seen as frame `seen_at` of `seen`; nothing
  // where it does not know the style.
  std::optional<StyleDelta> change(const std::string& style, const Take& seen, float seen_at,
                                   const Take& neutral, float at) {
    const std::vector<StyleInfo>& styles = networks_.model().styles();
    const auto found = std::find_if(styles.begin(), styles.end(),
                                    [&](const StyleInfo& s) { return s.name == style; });
    if (found == styles.end()) return std::nullopt;
    std::fill(strengths_.begin(), strengths_.end(), 0.0f);
    strengths_[found - styles.begin()] = strength_;
    networks_.set_strengths(strengths_);
    take_window(seen, seen_at, numbers_, window_);
    networks_.forward(window_);
    const auto root = std::span(window_).subspan(numbers_ - kRootNumbers).first<kRootNumbers>();
    return networks_.model().recipe().to_change(networks_.pose(), body_at(neutral, at), root);
  }

 private:
  StyleNetworks networks_;
  float strength_;
  std::vector<float> strengths_;
  int numbers_;
  std::vector<float> window_;
};

}  // namespace

AlignedTest::AlignedTest(std::vector<Take> takes)
    : positions_(std::move(takes)), rotations_(positions_), instants_(align(positions_)) {
  parallel_for(static_cast<int>(rotations_.size()),
               [&](int i) { write_numbers(PoseLayout::rotations, rotations_[i]); });
}

PoseErrors AlignedTest::errors(const Model& model, double strength) const {
  return model_errors(model, strength, takes(model.layout()), 1);
}

PoseErrors AlignedTest::errors(const Model& model, double strength, const SeenTakes& seen) const {
  return model_errors(model, strength, seen.takes, seen.speed);
}

PoseErrors AlignedTest::untouched_errors() const {
  return mean_errors([] { return [](const AlignedInstant&) { return StyleDelta{}; }; });
}

PoseErrors AlignedTest::model_errors(const Model& model, double strength,
                                     const std::vector<Take>& seen, float speed) const {
  return mean_errors([&]() -> Answer {
    return [&, reader = Reader(model, strength)](const AlignedInstant& i) mutable {
      return reader.change(positions_[i.styled].row.style, seen[i.neutral], i.at / speed,
                           positions_[i.neutral], i.at);
    };
  });
}

PoseErrors AlignedTest::mean_errors(const std::function<Answer()>& make_answer) const {
  std::vector<std::optional<PoseError>> errors(instants_.size());
  const size_t parts = (instants_.size() + kInstantsPerPart - 1) / kInstantsPerPart;
  parallel_for(static_cast<int>(parts), [&](int part) {
    const Answer answer = make_answer();
    const size_t first = part * kInstantsPerPart;
    for (size_t n = first; n < std::min(first + kInstantsPerPart, instants_.size()); ++n) {
      const AlignedInstant& i = instants_[n];
      if (const std::optional<StyleDelta> change = answer(i)) {
        errors[n] = pose_error(positions_[i.styled], i.frame, positions_[i.neutral], i.at, *change);
      }
    }
  });
  // In order, so that the sums are the same whichever thread was faster.
  PoseErrors means;
  std::map<std::pair<std::string, std::string>, double> counts;
  for (size_t n = 0; n < errors.size(); ++n) {
    if (!errors[n]) continue;
    const ManifestRow& row = positions_[instants_[n].styled].row;
    PoseError& mean = means[{row.style, row.content}];
    mean.degrees += errors[n]->degrees;
    mean.cm += errors[n]->cm;
    ++counts[{row.style, row.content}];
  }
  for (auto& [cell, mean] : means) {
    mean.degrees /= counts[cell];
    mean.cm /= counts[cell];
  }
  return means;
}

}  // namespace panache

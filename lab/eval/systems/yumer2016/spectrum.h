#pragma once
// Spectra of joint signals over a sliding window, and the transfer of a style between them.

#include <array>
#include <complex>
#include <vector>

#include "eval/systems/yumer2016/signals.h"

namespace panache::yumer2016 {

// Frames per window (2.1 s), and between the starts of two windows.
inline constexpr int kWindow = 64, kHop = 16, kBins = kWindow / 2 + 1;

// One window: the mean of each signal under a Hann window, and the spectrum of the remainder.
struct Spectrum {
  Signals mean{};
  std::array<std::array<std::complex<float>, kBins>, kSignals> bins{};
};
// Analyses the frames from `first` on; beyond its ends, a motion stands still.
Spectrum spectrum_of(const std::vector<Signals>& motion, int first);

// Reference data of an action, in a style or neutral: means and magnitudes over windows.
struct Reference {
  Signals mean{};
  std::array<std::array<float, kBins>, kSignals> magnitude{};
};
// Over all windows of these motions, at least one.
Reference reference_of(const std::vector<std::vector<Signals>>& motions);

// The distance of the window's posture and energies from those of the reference.
float distance(const Spectrum& window, const Reference& neutral);

// The change of a style for an action, at a strength.
struct Style {
  const Reference *neutral, *styled;
  float strength;
};

// Adds the style's differences to the magnitudes and means of `input`, scaled to the input's
// energy; keeps phases.
Spectrum transfer(const Spectrum& input, const std::vector<Style>& styles);

// Overlap-adds windows: spectra[i] belongs to the window that begins at frame first_window() + i *
// kHop; there are window_count() of them.
std::vector<Signals> overlap_add(const std::vector<Spectrum>& spectra, int frames);
constexpr int first_window() { return kHop - kWindow; }
constexpr int window_count(int frames) { return (frames - first_window() + kHop - 1) / kHop; }

}  // namespace panache::yumer2016

#pragma once
// Spectra of joint signals over a sliding window, and the transfer of a style between them.

#include <array>
#include <complex>
#include <vector>

#include "eval/systems/yumer2016/signals.h"

namespace panache::yumer2016 {

// Frames of a window (2.1 s), and between two of them.
inline constexpr int kWindow = 64, kHop = 16, kBins = kWindow / 2 + 1;

// Of one window: the mean of each signal under a Hann window, and the spectrum of the rest.
struct Spectrum {
  Signals mean{};
  std::array<std::array<std::complex<float>, kBins>, kSignals> bins{};
};
// Of the frames from `first` on; beyond its ends a motion stands still.
Spectrum spectrum_of(const std::vector<Signals>& motion, int first);

// What is known of a style's or the neutral way of an action: means and magnitudes over windows.
struct Reference {
  Signals mean{};
  std::array<std::array<float, kBins>, kSignals> magnitude{};
};
// Over all windows of these motions, which are some.
Reference reference_of(const std::vector<std::vector<Signals>>& motions);

// How unlike the window's posture and energies are to those of the reference.
float distance(const Spectrum& window, const Reference& neutral);

// A style on an action: what it changes, at a strength.
struct Style {
  const Reference *neutral, *styled;
  float strength;
};

// Magnitudes and means of `input` with the styles' differences on them, scaled to the input's
// energy; phases as they are.
Spectrum transfer(const Spectrum& input, const std::vector<Style>& styles);

// Puts windows together again: spectra[i] is of the window that begins at frame first_window() + i
// * kHop, as many as window_count().
std::vector<Signals> overlap_add(const std::vector<Spectrum>& spectra, int frames);
constexpr int first_window() { return kHop - kWindow; }
constexpr int window_count(int frames) { return (frames - first_window() + kHop - 1) / kHop; }

}  // namespace panache::yumer2016

#include "eval/systems/yumer2016/spectrum.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <unsupported/Eigen/FFT>

namespace panache::yumer2016 {
namespace {

// A joint that moves less in a reference gives no usable energy ratio. Radians (metres, m/s), root
// mean square.
constexpr float kStill = 0.02f;
// Limit of the energy ratio to the reference.
constexpr float kMaxScale = 2;

using Window = std::array<float, kWindow>;

// Periodic, so that windows kHop apart add up to a constant.
const Window& hann() {
  static const Window window = [] {
    Window w;
    for (int i = 0; i < kWindow; ++i) {
      w[i] =
          0.5f - 0.5f * std::cos(2 * std::numbers::pi_v<float> * static_cast<float>(i) / kWindow);
    }
    return w;
  }();
  return window;
}

Eigen::FFT<float>& plan() {
  thread_local Eigen::FFT<float> fft(Eigen::default_fft_impl<float>(),
                                     Eigen::FFT<float>::HalfSpectrum);
  return fft;
}

// Signals that belong together: the three angles of a joint, or a single signal.
struct Group {
  int first, count;
};
constexpr int kGroups = kHumanJoints + 2;
constexpr Group group(int g) {
  return g < kHumanJoints ? Group{3 * g, 3} : Group{kHipsHeight + g - kHumanJoints, 1};
}

template <class Bins>
float energy(const Bins& bins, Group of) {
  float sum = 0;
  for (int s = of.first; s < of.first + of.count; ++s) {
    for (const auto& bin : bins[s]) sum += std::norm(bin);
  }
  return sum;
}
// The energy of a sine with root mean square kStill: its two sides have (amplitude / 2 * sum of
// Hann)^2.
constexpr float kStillSide = kStill * kWindow / 4;
constexpr float kStillEnergy = 2 * kStillSide * kStillSide;

}  // namespace

Spectrum spectrum_of(const std::vector<Signals>& motion, int first) {
  Spectrum out;
  const int last = static_cast<int>(motion.size()) - 1;
  const auto at = [&](int i) -> const Signals& { return motion[std::clamp(first + i, 0, last)]; };
  Window values;
  for (int s = 0; s < kSignals; ++s) {
    float sum = 0;
    for (int i = 0; i < kWindow; ++i) sum += hann()[i] * at(i)[s];
    out.mean[s] = sum / (kWindow / 2.0f);
    for (int i = 0; i < kWindow; ++i) values[i] = hann()[i] * (at(i)[s] - out.mean[s]);
    plan().fwd(out.bins[s].data(), values.data(), kWindow);
  }
  return out;
}

Reference reference_of(const std::vector<std::vector<Signals>>& motions) {
  Reference out;
  float count = 0;
  for (const std::vector<Signals>& motion : motions) {
    // Windows within the motion, or a single one that covers it.
    const int last = std::max(0, static_cast<int>(motion.size()) - kWindow);
    for (int first = 0; first <= last; first += kHop) {
      const Spectrum window = spectrum_of(motion, first);
      for (int s = 0; s < kSignals; ++s) {
        out.mean[s] += window.mean[s];
        for (int b = 0; b < kBins; ++b) out.magnitude[s][b] += std::abs(window.bins[s][b]);
      }
      ++count;
    }
  }
  for (int s = 0; s < kSignals; ++s) {
    out.mean[s] /= count;
    for (float& magnitude : out.magnitude[s]) magnitude /= count;
  }
  return out;
}

float distance(const Spectrum& window, const Reference& neutral) {
  float sum = 0;
  for (int g = 0; g < kGroups; ++g) {
    const Group of = group(g);
    for (int s = of.first; s < of.first + of.count; ++s) {
      const float apart = window.mean[s] - neutral.mean[s];
      sum += apart * apart;
    }
    // Energies, converted to the amplitude of one sine.
    const float amplitude =
        std::sqrt(energy(window.bins, of)) - std::sqrt(energy(neutral.magnitude, of));
    sum += amplitude * amplitude / (kWindow * kWindow / 16.0f);
  }
  return sum;
}

Spectrum transfer(const Spectrum& input, const std::vector<Style>& styles) {
  Spectrum out = input;
  for (int g = 0; g < kGroups; ++g) {
    const Group of = group(g);
    const float own = energy(input.bins, of);
    for (const Style& style : styles) {
      const float reference = energy(style.neutral->magnitude, of);
      const float scale =
          std::min(kMaxScale, std::sqrt((own + kStillEnergy) / (reference + kStillEnergy)));
      for (int s = of.first; s < of.first + of.count; ++s) {
        out.mean[s] += style.strength * (style.styled->mean[s] - style.neutral->mean[s]);
        for (int b = 0; b < kBins; ++b) {
          const float more = style.styled->magnitude[s][b] - style.neutral->magnitude[s][b];
          const float magnitude = std::abs(input.bins[s][b]);
          if (magnitude > 0) {
            out.bins[s][b] += input.bins[s][b] * (style.strength * scale * more / magnitude);
          }
        }
      }
    }
    // Negative magnitudes would invert the phase.
    for (int s = of.first; s < of.first + of.count; ++s) {
      for (int b = 0; b < kBins; ++b) {
        const std::complex<float> before = input.bins[s][b];
        if (std::real(out.bins[s][b] * std::conj(before)) < 0) out.bins[s][b] = 0;
      }
    }
  }
  return out;
}

std::vector<Signals> overlap_add(const std::vector<Spectrum>& spectra, int frames) {
  std::vector<Signals> out(frames, Signals{});
  std::vector<float> weights(frames);
  Window values;
  for (size_t w = 0; w < spectra.size(); ++w) {
    const int first = first_window() + static_cast<int>(w) * kHop;
    const int begin = std::max(0, -first), end = std::min(kWindow, frames - first);
    for (int s = 0; s < kSignals; ++s) {
      plan().inv(values.data(), spectra[w].bins[s].data(), kWindow);
      for (int i = begin; i < end; ++i) {
        // A second Hann window avoids edges in the changed windows.
        out[first + i][s] += hann()[i] * (values[i] + hann()[i] * spectra[w].mean[s]);
      }
    }
    for (int i = begin; i < end; ++i) weights[first + i] += hann()[i] * hann()[i];
  }
  for (int f = 0; f < frames; ++f) {
    for (float& value : out[f]) value /= weights[f];
  }
  return out;
}

}  // namespace panache::yumer2016

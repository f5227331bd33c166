#pragma once
// What of its manifests a training learns from, and what it leaves out.

#include <string>
#include <vector>

#include "base/result.h"
#include "learn/manifest.h"
#include "learn/samples.h"

namespace panache {

// What a style is learnt from; takes that are held back for validation do not count.
struct StyleCoverage {
  std::string style;
  size_t takes = 0;    // With samples.
  double seconds = 0;  // Of these takes.
  size_t samples = 0;
};

// A sentence for each content of each manifest and performer, and for each of these as a whole,
// that no style is learnt from because either the neutral takes or the styled ones are missing, and
// for each content that is compared with other performers' neutral takes. Rows marked test do not
// count.
std::vector<std::string> list_unpaired(const std::vector<ManifestRow>& rows);

// Fails, with the names of all of them, where a style has no take with a neutral take of the same
// content in its manifest. Rows marked test do not count.
Result<void> check_styles(const std::vector<ManifestRow>& rows,
                          const std::vector<StyleName>& styles);

// The coverage of each style, in the order of `styles`. `choice`: the samples that are trained on.
std::vector<StyleCoverage> cover_styles(const std::vector<Take>& takes, const SampleSet& set,
                                        const std::vector<int>& choice,
                                        const std::vector<std::string>& styles);

// A sentence for each style and content that has a neutral take and no sample all the same.
std::vector<std::string> list_too_short(const std::vector<Take>& takes, const SampleSet& set);

// Fails, with the names of all of them, where a style has no sample.
Result<void> check_samples(const std::vector<StyleCoverage>& styles);

}  // namespace panache

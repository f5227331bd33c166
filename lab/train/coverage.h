#pragma once
// Reports which rows of the manifests are trained on, and which are left out.

#include <string>
#include <vector>

#include "base/result.h"
#include "takes/manifest.h"
#include "learn/samples.h"

namespace panache {

// The training data of one style, without takes held back for validation.
struct StyleCoverage {
  std::string style;
  size_t takes = 0;    // Only takes with samples.
  double seconds = 0;  // Of these takes.
  size_t samples = 0;
};

// One message for each content of a manifest and performer (or for a whole manifest or performer)
// that teaches no style because neutral or styled takes are missing, and one for each content
// paired with other performers' neutral takes. Ignores rows marked test.
std::vector<std::string> list_unpaired(const std::vector<ManifestRow>& rows);

// Fails, listing all such styles, if a style has no take with a neutral take of the same content in
// its manifest. Ignores rows marked test.
Result<void> check_styles(const std::vector<ManifestRow>& rows,
                          const std::vector<StyleName>& styles);

// The coverage of each style, in the order of `styles`. `choice`: the training samples.
std::vector<StyleCoverage> cover_styles(const std::vector<Take>& takes, const SampleSet& set,
                                        const std::vector<int>& choice,
                                        const std::vector<std::string>& styles);

// One message for each style and content that has a neutral take but no sample.
std::vector<std::string> list_too_short(const std::vector<Take>& takes, const SampleSet& set);

// Fails, listing all such styles, if a style has no sample.
Result<void> check_samples(const std::vector<StyleCoverage>& styles);

}  // namespace panache

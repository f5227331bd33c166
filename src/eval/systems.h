#pragma once
// Systems at work: neutral takes through the whole of a model's stylizer, as a user would.

#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "clip/clip.h"
#include "eval/judge.h"
#include "rig/rig.h"
#include "style/model.h"

namespace panache {

// A take as the file it comes from.
struct TestInput {
  Clip clip;
  Rig rig;
  Take take;  // The same, canonical; numbers in layout positions.

  double take_frame(double clip_frame) const;  // The take's frame at a frame of the clip.
};
// Over all cores; of a row only the path is read, and fails with the sentence of the first file, in
// order, that cannot be read or mapped.
Result<std::vector<TestInput>> load_inputs(const std::vector<ManifestRow>& rows);
std::vector<Take> takes_of(const std::vector<TestInput>& inputs);

// One thing to ask for: strengths of styles of a model, and the style it is judged as.
struct Request {
  std::string style;
  std::vector<std::pair<std::string, float>> strengths;
};

// What a model made of an input, and what that did to the skeleton.
struct Played {
  Output output;
  double bone_length_error = 0;  // Metres.
};
// Input `which`, with the style's own tempo unless `timing` is off.
Result<Played> run_system(std::shared_ptr<const Model> model, const std::vector<TestInput>& inputs,
                          int which, const Request& request, bool timing = true);

// The inputs themselves, as if they were the output for each style.
std::vector<Output> untouched(const std::vector<TestInput>& inputs,
                              const std::vector<std::string>& styles);

}  // namespace panache

#include "eval/system.h"

#include <algorithm>

namespace panache {

bool System::can_run(const TestInput&, const StyleRequest& request) const {
  const std::vector<std::string> known = styles();
  return std::all_of(request.strengths.begin(), request.strengths.end(), [&](const auto& asked) {
    return std::find(known.begin(), known.end(), asked.first) != known.end();
  });
}

std::unique_ptr<InstantAnswers> System::instants(double) const { return nullptr; }

double System::step_us(const TestInput&) const { return kNotMeasured; }

std::vector<StyledTake> untouched(const std::vector<TestInput>& inputs,
                                  const std::vector<std::string>& styles) {
  std::vector<StyledTake> outputs;
  for (size_t i = 0; i < inputs.size(); ++i) {
    for (const std::string& style : styles) {
      StyledTake output{inputs[i].take, static_cast<int>(i), {}};
      output.take.row.style = style;
      for (int f = 0; f < output.take.frames(); ++f) {
        output.source_frames.push_back(static_cast<float>(f));
      }
      outputs.push_back(std::move(output));
    }
  }
  return outputs;
}

}  // namespace panache

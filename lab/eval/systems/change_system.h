#pragma once
// A system that answers instants with changes, which our stages carry out: root motion, filter,
// anatomy, balance, floor, flights and feet are the same for all systems.

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "eval/system.h"
#include "style/change_source.h"
#include "style/restyle.h"

namespace panache {

class ChangeSystem : public System {
 public:
  std::vector<std::string> styles() const override { return styles_; }
  Result<RunResult> run(const TestInput& input, const StyleRequest& request) const override;
  // Of the source alone: no filter, no root, no foot lock. Instants that follow each other are one
  // motion to it.
  std::unique_ptr<InstantAnswers> instants(double strength) const override;
  // One frame of the output; where a source looks at whole takes first, its share of that.
  double step_us(const TestInput& input) const override;

  // Index and strength of each style in force.
  using Strengths = std::vector<std::pair<int, float>>;
  // Answers for one character that moves as `take` (numbers in layout positions, which outlives
  // it), whose first frame is `begin` seconds of a clip. Systems that work online look at neither.
  virtual std::unique_ptr<ChangeSource> make_source(const Take& take, double begin,
                                                    const Strengths& strengths) const = 0;

 protected:
  ChangeSystem(std::string name, std::vector<std::string> styles)
      : System(std::move(name)), styles_(std::move(styles)) {}

 private:
  Strengths strengths_of(const StyleRequest& request) const;
  Restyled play(const TestInput& input, const Strengths& strengths, bool loop, bool timing) const;

  std::vector<std::string> styles_;
};

}  // namespace panache

#pragma once
// A system that answers instants with changes: how its answers become motion, and how long they
// take, is the same for all of them.

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "eval/system.h"
#include "eval/systems/change_source.h"

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
  // it). Systems that work online look at nothing of it.
  virtual std::unique_ptr<ChangeSource> make_source(const Take& take,
                                                    const Strengths& strengths) const = 0;

 protected:
  ChangeSystem(std::string name, std::vector<std::string> styles)
      : System(std::move(name)), styles_(std::move(styles)) {}

 private:
  Strengths strengths_of(const StyleRequest& request) const;

  std::vector<std::string> styles_;
};

}  // namespace panache

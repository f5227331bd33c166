#pragma once
// A system that outputs a change for each instant. Our stages apply it: root motion, filter,
// anatomy, balance, floor, flights and feet are the same for all systems.

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "eval/system.h"
#include "style/networks/change_source.h"
#include "style/restyle.h"

namespace panache {

class ChangeSystem : public System {
 public:
  std::vector<std::string> styles() const override { return styles_; }
  Result<RunResult> run(const TestInput& input, const StyleRequest& request) const override;
  // The source alone: no filter, root motion or foot lock. Consecutive instants are one motion.
  std::unique_ptr<InstantAnswers> instants(double strength) const override;
  // CPU time of one output frame, including a share of the preparation of whole takes.
  double step_us(const TestInput& input) const override;

  // Index and strength of each active style.
  using Strengths = std::vector<std::pair<int, float>>;
  // Makes the changes for a character that moves as `take` (features in layout positions; must
  // outlive the source), whose first frame is at `begin` seconds of a clip. Online systems ignore
  // both.
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

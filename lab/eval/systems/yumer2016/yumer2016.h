#pragma once
// Yumer and Mitra 2016, "Spectral style transfer for human motion between independent actions", as
// we implemented it: docs/comparison-systems.md.

#include "eval/systems/change_system.h"
#include "eval/systems/table.h"
#include "eval/systems/yumer2016/spectrum.h"

namespace panache {

class Yumer2016 : public ChangeSystem {
 public:
  // References: the training takes of each action, styled and neutral, in the sets of `data` with
  // pairs. Fails if no style has any.
  static Result<std::unique_ptr<Yumer2016>> create(const std::string& name, const SystemData& data);

  SystemFacts facts() const override;  // Bytes: of the references.
  std::unique_ptr<ChangeSource> make_source(const Take& take, double begin,
                                            const Strengths& strengths) const override;

 private:
  // An action, in one style and neutral.
  struct Action {
    yumer2016::Reference neutral, styled;
  };
  Yumer2016(std::string name, std::vector<std::string> styles,
            std::vector<std::vector<Action>> actions);

  std::vector<std::vector<Action>> actions_;  // Of each style.
};

}  // namespace panache

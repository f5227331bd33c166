#pragma once
// Holden et al. 2017, "Fast neural style transfer for motion data", as we implemented it:
// docs/comparison-systems.md. Needs whole clips, so it is not live.

#include "eval/systems/change_system.h"
#include "eval/systems/holden2017/transfer.h"
#include "eval/systems/table.h"

namespace panache {

struct HoldenSettings {
  holden2017::AutoencoderSettings autoencoder;
  holden2017::TransferSettings transfer;
  int all_steps = 6000;  // Maximum for the networks of all styles together.
};

class Holden2017 : public ChangeSystem {
 public:
  // Trains the autoencoder on all neutral motion of `data`, and a network for each style. Fails if
  // no style has a pair.
  static Result<std::unique_ptr<Holden2017>> create(const std::string& name, const SystemData& data,
                                                    const HoldenSettings& settings = {});

  SystemFacts facts() const override;
  std::unique_ptr<ChangeSource> make_source(const Take& take, double begin,
                                            const Strengths& strengths) const override;

 private:
  Holden2017(std::string name, std::vector<std::string> styles, holden2017::RowUnits units,
             std::vector<holden2017::Transfer> networks);

  holden2017::RowUnits units_;
  std::vector<holden2017::Transfer> networks_;  // Of each style.
};

}  // namespace panache

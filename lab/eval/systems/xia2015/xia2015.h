#pragma once
// Xia et al. 2015, "Realtime style transfer for unlabeled heterogeneous human motion", as we
// implemented it: docs/comparison-systems.md.

#include "eval/systems/change_system.h"
#include "eval/systems/table.h"
#include "eval/systems/xia2015/local_model.h"

namespace panache {

class Xia2015 : public ChangeSystem {
 public:
  // Registers the pairs of `data`. Skips styles without a pair; fails if none has one.
  static Result<std::unique_ptr<Xia2015>> create(const std::string& name, const SystemData& data,
                                                 const xia2015::LocalSettings& settings = {});

  SystemFacts facts() const override;  // Bytes: of the examples of all styles.
  std::unique_ptr<ChangeSource> make_source(const Take& take, double begin,
                                            const Strengths& strengths) const override;

 private:
  Xia2015(std::string name, std::vector<std::string> styles, xia2015::WindowKey key,
          std::vector<xia2015::Database> databases, const xia2015::LocalSettings& settings);

  xia2015::WindowKey key_;
  std::vector<xia2015::Database> databases_;  // Of each style.
  xia2015::LocalSettings settings_;
};

}  // namespace panache

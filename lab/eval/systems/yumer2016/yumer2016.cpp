#include "eval/systems/yumer2016/yumer2016.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "base/parallel.h"
#include "base/progress.h"
#include "eval/systems/whole_take.h"
#include "takes/manifest.h"

namespace panache {

using namespace yumer2016;

Result<std::unique_ptr<Yumer2016>> Yumer2016::create(const std::string& name,
                                                     const SystemData& data) {
  Progress progress("measuring the spectra of " + name);
  // Set, action, style ("" for neutral): its takes. Excludes actions without pairs.
  using Cell = std::tuple<int, std::string, std::string>;
  std::map<Cell, std::set<int>> cells;
  for (const Pairing& pairing : data.pairings) {
    const ManifestRow& row = data.takes[pairing.styled].row;
    cells[{row.set, row.content, row.style}].insert(pairing.styled);
    cells[{row.set, row.content, ""}].insert(pairing.neutral);
  }
  std::vector<const std::pair<const Cell, std::set<int>>*> list;
  list.reserve(cells.size());
  for (const auto& cell : cells) list.push_back(&cell);
  std::vector<Reference> references(list.size());
  parallel_for(static_cast<int>(list.size()), [&](int i) {
    std::vector<std::vector<Signals>> motions;
    for (const int t : list[i]->second) motions.push_back(joint_signals(data.takes[t]));
    references[i] = reference_of(motions);
  });
  std::map<Cell, const Reference*> found;
  for (size_t i = 0; i < list.size(); ++i) found[list[i]->first] = &references[i];

  std::vector<std::string> styles;
  std::vector<std::vector<Action>> actions;
  for (const StyleName& style : data.styles) {
    std::vector<Action> own;
    for (const auto& [cell, styled] : found) {
      const auto& [set, content, of] = cell;
      if (of == style.name) own.push_back({*found.at({set, content, ""}), *styled});
    }
    if (own.empty()) continue;
    styles.push_back(style.name);
    actions.push_back(std::move(own));
  }
  if (styles.empty()) {
    return Error{name + ": there is no pair of a neutral and a styled take to learn from"};
  }
  return std::unique_ptr<Yumer2016>(new Yumer2016(name, std::move(styles), std::move(actions)));
}

Yumer2016::Yumer2016(std::string name, std::vector<std::string> styles,
                     std::vector<std::vector<Action>> actions)
    : ChangeSystem(std::move(name), std::move(styles)), actions_(std::move(actions)) {}

SystemFacts Yumer2016::facts() const {
  SystemFacts facts;
  for (const std::vector<Action>& actions : actions_)
    facts.bytes += actions.size() * sizeof(Action);
  return facts;
}

std::unique_ptr<ChangeSource> Yumer2016::make_source(const Take& take, double begin,
                                                     const Strengths& strengths) const {
  if (strengths.empty())
    return std::make_unique<WholeTakeSource>(take, begin, std::vector<StyleDelta>());
  const std::vector<Signals> motion = joint_signals(take);
  const int frames = take.frames();
  std::vector<Spectrum> windows(window_count(frames));
  for (size_t w = 0; w < windows.size(); ++w) {
    const Spectrum window = spectrum_of(motion, first_window() + static_cast<int>(w) * kHop);
    std::vector<Style> styles;
    for (const auto& [style, strength] : strengths) {
      const std::vector<Action>& known = actions_[style];
      const Action* nearest =
          &*std::min_element(known.begin(), known.end(), [&](const Action& a, const Action& b) {
            return distance(window, a.neutral) < distance(window, b.neutral);
          });
      styles.push_back({&nearest->neutral, &nearest->styled, strength});
    }
    windows[w] = transfer(window, styles);
  }
  const std::vector<Signals> styled = overlap_add(windows, frames);
  std::vector<StyleDelta> changes;
  changes.reserve(static_cast<size_t>(frames));
  for (int f = 0; f < frames; ++f) changes.push_back(change_of(motion[f], styled[f]));
  return std::make_unique<WholeTakeSource>(take, begin, std::move(changes));
}

}  // namespace panache

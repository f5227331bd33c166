#include "train/coverage.h"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "base/text.h"
#include "train/removal.h"

namespace panache {
namespace {

using Content = std::pair<int, std::string>;  // Set, content.

// The takes of a content by one performer, or of a manifest without performers.
struct Takes {
  std::string manifest, person;
  size_t neutral = 0, styled = 0;
  bool borrows = false;  // Only other performers of the manifest have neutral takes.
  std::set<std::string> styles;

  bool is_paired() const { return (neutral > 0 || borrows) && styled > 0; }
};

std::map<Content, Takes> contents_of(const std::vector<ManifestRow>& rows) {
  std::map<Content, Takes> contents;
  for (const ManifestRow& row : rows) {
    if (row.test) continue;
    Takes& takes = contents[{row.set, row.content}];
    takes.manifest = row.manifest;
    takes.person = row.person;
    ++(row.neutral ? takes.neutral : takes.styled);
    if (!row.neutral) takes.styles.insert(row.style);
  }
  std::set<std::pair<std::string, std::string>> shared;  // Manifest, content.
  for (const auto& [content, takes] : contents) {
    if (takes.neutral > 0) shared.emplace(takes.manifest, content.second);
  }
  for (auto& [content, takes] : contents) {
    takes.borrows = !takes.person.empty() && takes.neutral == 0 &&
                    shared.contains({takes.manifest, content.second});
  }
  return contents;
}

std::string location_of(const Takes& takes) {
  return (takes.manifest.empty() ? "" : takes.manifest + ": ") +
         (takes.person.empty() ? "" : "performer '" + takes.person + "': ");
}

}  // namespace

std::vector<std::string> list_unpaired(const std::vector<ManifestRow>& rows) {
  std::vector<std::string> lines;
  const std::map<Content, Takes> contents = contents_of(rows);
  std::map<int, bool> learns;  // Whether a set teaches anything.
  for (const auto& [content, takes] : contents) learns[content.first] |= takes.is_paired();
  for (auto at = contents.begin(); at != contents.end(); ++at) {
    const auto& [content, takes] = *at;
    const bool is_first = at == contents.begin() || std::prev(at)->first.first != content.first;
    if (is_first && !learns[content.first]) {
      lines.push_back(location_of(takes) +
                      (takes.person.empty() ? "the manifest is" : "all takes are") +
                      " left out: no content of " + (takes.person.empty() ? "it" : "theirs") +
                      " has both a neutral and a styled take");
    }
    const std::string where = location_of(takes) + "content '" + content.second + "' ";
    const std::string what = where + "is left out: ";
    if (takes.borrows) {
      lines.push_back(where + "has no neutral take: styled takes are compared with the neutral " +
                      "ones of the other performers");
    } else if (takes.neutral == 0) {
      lines.push_back(what + "it has no neutral take (" + plural(takes.styled, "take") + " of " +
                      one_of(takes.styles, ", ") + ")");
    } else if (takes.styled == 0) {
      lines.push_back(what + "it has no styled take (" + plural(takes.neutral, "neutral take") +
                      ")");
    }
  }
  return lines;
}

Result<void> check_styles(const std::vector<ManifestRow>& rows,
                          const std::vector<StyleName>& styles) {
  const std::map<Content, Takes> contents = contents_of(rows);
  std::string list;
  size_t missing = 0;
  for (const StyleName& style : styles) {
    std::set<std::string> shown;
    bool learnt = false;
    for (const auto& [content, takes] : contents) {
      if (!takes.styles.contains(style.name)) continue;
      shown.insert(content.second);
      learnt = learnt || takes.is_paired();
    }
    if (learnt) continue;
    ++missing;
    list += (list.empty() ? "'" : ", '") + style.name + "' (" +
            (shown.empty() ? "no take to train on" : one_of(shown, ", ")) + ")";
  }
  if (missing == 0) return {};
  return Error{"nothing can be learnt of " + plural(missing, "style") + ": " + list +
               "; expected a neutral take of one of these contents, to train on, in the manifest "
               "of the style; add one, or leave the " +
               (missing == 1 ? "style" : "styles") + " out (--styles lists those to learn)"};
}

std::vector<StyleCoverage> cover_styles(const std::vector<Take>& takes, const SampleSet& set,
                                        const std::vector<int>& choice,
                                        const std::vector<std::string>& styles) {
  std::vector<StyleCoverage> covered(styles.size());
  for (size_t s = 0; s < styles.size(); ++s) covered[s].style = styles[s];
  std::set<int> seen;
  for (const int i : choice) {
    const Sample& sample = set.samples()[i];
    if (sample.style < 0) continue;
    StyleCoverage& style = covered[sample.style];
    ++style.samples;
    const int take = take_with_style(takes, sample);
    if (!seen.insert(take).second) continue;
    ++style.takes;
    style.seconds += takes[take].frames() / kTakeRate;
  }
  return covered;
}

std::vector<std::string> list_too_short(const std::vector<Take>& takes, const SampleSet& set) {
  std::vector<ManifestRow> rows;
  for (const Take& take : takes) rows.push_back(take.row);
  const std::map<Content, Takes> contents = contents_of(rows);
  using Cell = std::tuple<int, std::string, std::string>;  // Set, content, style.
  std::map<Cell, double> longest;                          // Seconds.
  for (const Take& take : takes) {
    const ManifestRow& row = take.row;
    if (row.neutral || !contents.at({row.set, row.content}).is_paired()) continue;
    double& seconds = longest[{row.set, row.content, row.style}];
    seconds = std::max(seconds, take.frames() / kTakeRate);
  }
  for (const Sample& sample : set.samples()) {
    if (sample.styled < 0) continue;
    const ManifestRow& row = takes[take_with_style(takes, sample)].row;
    longest.erase({row.set, row.content, row.style});
  }
  std::vector<std::string> lines;
  for (const auto& [cell, seconds] : longest) {
    const auto& [number, content, style] = cell;
    char text[32];
    std::snprintf(text, sizeof text, "%.1f", seconds);
    lines.push_back(location_of(contents.at({number, content})) + "style '" + style +
                    "' is left out in content '" + content +
                    "': its takes or the neutral ones are too short (its longest has " + text +
                    " s)");
  }
  return lines;
}

Result<void> check_samples(const std::vector<StyleCoverage>& styles) {
  std::string list;
  for (const StyleCoverage& style : styles) {
    if (style.samples == 0) list += (list.empty() ? "'" : ", '") + style.style + "'";
  }
  if (list.empty()) return {};
  return Error{"no samples of the style " + list +
               "; expected longer takes, styled and neutral; add some, or leave the style out "
               "(--styles lists those to learn)"};
}

}  // namespace panache

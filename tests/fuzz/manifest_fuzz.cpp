// A manifest and, behind a zero byte, the table of its styles, as training and evaluation take
// them: styles renamed, takes read, styled ones laid over neutral ones, samples cut.

#include <filesystem>
#include <fstream>
#include <map>

#include "clip/bvh.h"
#include "learn/pairing.h"
#include "learn/samples.h"
#include "learn/take.h"
#include "make_clip.h"
#include "takes/load_takes.h"
#include "takes/manifest.h"
#include "temporary_folder.h"
#include "use_motion.h"

namespace {

using namespace panache;

// The motion that a manifest may list: a walk, one that is too short for a window, a single frame.
const std::string& folder() {
  static const test::TemporaryFolder made;
  static const bool filled = [] {
    for (const auto& [name, frames] : {std::pair{"walk", 60}, {"short", 20}, {"still", 1}}) {
      std::ofstream(made.path() + name + ".bvh") << format_bvh(test::walking_clip(frames));
    }
    return true;
  }();
  static_cast<void>(filled);
  return made.path();
}

// The takes of rows that name a file of ours by its own name. Others stay unread: there are files
// that never end.
std::vector<Take> load(const std::vector<ManifestRow>& rows) {
  constexpr size_t kMaxTakes = 6;
  static std::map<std::string, Take> known;
  std::vector<Take> takes;
  for (const ManifestRow& row : rows) {
    const std::filesystem::path path(row.path);
    if (path.parent_path() != std::filesystem::path(folder()).parent_path()) continue;
    if (known.find(row.path) == known.end()) {
      const Result<Take> take = load_take(row, PoseLayout::positions);
      if (!take) continue;
      known.emplace(row.path, *take);
    }
    takes.push_back(known.at(row.path));
    takes.back().row = row;
    if (takes.size() == kMaxTakes) break;
  }
  return takes;
}

void prepare(const std::vector<ManifestRow>& rows, const std::vector<StyleName>& names) {
  const std::vector<Take> takes = load(rows);
  std::vector<int> styled, neutral;
  for (size_t i = 0; i < takes.size(); ++i) {
    (takes[i].row.neutral ? neutral : styled).push_back(static_cast<int>(i));
  }
  if (styled.empty() || neutral.empty()) return;
  const std::vector<Pairing> pairings = pair_takes(takes, styled, neutral);
  if (pairings.empty()) return;
  std::vector<std::string> styles;
  for (const StyleName& style : names) styles.push_back(style.name);
  const SampleSet set(takes, pairings, styles, fuzz::small_model()->recipe(), true);
  std::vector<float> window(static_cast<size_t>(set.inputs()));
  for (size_t i = 0; i < set.samples().size(); i += 7) set.window(i, window);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const size_t end = std::min(text.find('\0'), text.size());
  const std::string manifest = folder() + "manifest.csv", table = folder() + "styles.csv";
  std::ofstream(manifest, std::ios::binary) << text.substr(0, end);
  Result<std::vector<ManifestRow>> rows = read_manifest(manifest, 0);
  std::vector<StyleName> names;
  if (end < text.size()) {
    std::ofstream(table, std::ios::binary) << text.substr(end + 1);
    Result<std::vector<StyleName>> read = read_style_names(table);
    if (!read) return 0;
    names = *std::move(read);
  }
  if (!rows || !apply_style_names(names, *rows)) return 0;
  prepare(*rows, names);
  return 0;
}

#include "eval/systems/recorded.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <set>

#include "base/csv.h"
#include "base/parallel.h"
#include "base/text.h"
#include "eval/motion_metrics.h"
#include "takes/manifest.h"

namespace panache {
namespace {

namespace fs = std::filesystem;

std::string normal(const std::string& path) { return fs::path(path).lexically_normal().string(); }

// Whether `path` ends in `end`, in whole names of folders and files.
bool ends_in(const std::string& path, const std::string& end) {
  return path.ends_with(end) && (path.size() == end.size() || end.starts_with('/') ||
                                 path[path.size() - end.size() - 1] == '/');
}

// The evaluated path that a cell of the column input refers to.
Result<std::string> find_input(const std::string& cell, const std::vector<std::string>& inputs) {
  std::set<std::string> found;
  for (const std::string& path : inputs) {
    if (!cell.empty() && ends_in(normal(path), normal(cell))) found.insert(normal(path));
  }
  if (found.empty()) {
    return Error{"input '" + cell +
                 "' is no take to judge by; expected a path as in the judge's own manifest "
                 "(panache-lab eval --requests FILE writes those that there are)"};
  }
  if (found.size() > 1) {
    return Error{"input '" + cell + "' may be " + *found.begin() + " or " + *found.rbegin() +
                 "; expected more of the path"};
  }
  return *found.begin();
}

Result<float> read_strength(const std::string& cell) {
  double value = kNotMeasured;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  const bool whole = error == std::errc() && end == cell.data() + cell.size();
  if (!whole || std::find(kStrengths.begin(), kStrengths.end(), value) == kStrengths.end()) {
    return Error{"column strength is '" + cell +
                 "'; expected 0, 0.25, 0.5, 0.75, 1, 1.25, 1.5, 1.75 or 2"};
  }
  return static_cast<float>(value);
}

// Corrects an output that is one frame too long or too short because its rate was rounded: drops
// that frame, or repeats the last one.
void set_frames(Take& take, int frames) {
  take.body.resize(frames, take.body.back());
  take.root.resize(frames, take.root.back());
  take.rotations.resize(frames, take.rotations.back());
  take.contacts.resize(frames, take.contacts.back());
  write_numbers(PoseLayout::positions, take);
}

std::string seconds_text(int frames) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f s", frames / kTakeRate);
  return text;
}

}  // namespace

std::string Recorded::name_of(const std::string& folder) {
  const fs::path path = normal(folder);
  return (path.has_filename() ? path : path.parent_path()).filename().string();  // "outputs/"
}

Result<std::unique_ptr<Recorded>> Recorded::load(const std::string& folder,
                                                 const RecordedScope& scope) {
  std::unique_ptr<Recorded> recorded(new Recorded(name_of(folder)));
  if (Result<void> read = recorded->read_manifest(folder, scope); !read) return read.error();
  if (Result<void> read = recorded->read_outputs(); !read) return read.error();
  return recorded;
}

Result<void> Recorded::read_manifest(const std::string& folder, const RecordedScope& scope) {
  const std::string path = (fs::path(folder) / "manifest.csv").string();
  Result<CsvTable> table = read_csv(path, {"input", "style", "strength", "output"});
  if (!table) return table.error();
  for (const CsvRow& cells : table->rows) {
    const std::string where = path + ":" + std::to_string(cells.line);
    const std::string& style = cells.values[1];
    Result<std::string> input = find_input(cells.values[0], scope.inputs);
    if (!input) return located(where, input.error());
    if (std::find(scope.styles.begin(), scope.styles.end(), style) == scope.styles.end()) {
      return Error{where + ": style '" + style + "' is shown by no test take; expected " +
                   one_of(scope.styles)};
    }
    Result<float> strength = read_strength(cells.values[2]);
    if (!strength) return located(where, strength.error());
    const auto [line, is_new] = lines_.try_emplace({*input, style, *strength});
    if (!is_new) return Error{where + ": asks for the same as " + line->second.where};
    line->second.where = where;
    line->second.output = (fs::path(folder) / cells.values[3]).string();
    if (std::find(styles_.begin(), styles_.end(), style) == styles_.end()) {
      styles_.push_back(style);
    }
  }
  if (lines_.empty()) return Error{path + ": lists no outputs"};
  std::sort(styles_.begin(), styles_.end());
  return {};
}

Result<void> Recorded::read_outputs() {
  std::vector<Line*> lines;
  lines.reserve(lines_.size());
  for (auto& [key, line] : lines_) lines.push_back(&line);
  std::vector<std::optional<Error>> errors(lines.size());
  parallel_for(static_cast<int>(lines.size()), [&](int i) {
    ManifestRow row;
    row.path = lines[i]->output;
    Result<TestInput> output = load_input(row);
    if (!output) {
      errors[i] = Error{lines[i]->where + ": output " + output.error().message};
      return;
    }
    const Clip& clip = output->clip;
    const std::vector<double> first(static_cast<size_t>(clip.frames), output->rig.first_frame());
    lines[i]->bone_length_error =
        bone_length_error(clip, clip, first, output->rig.joints()[0]) * output->rig.scale();
    lines[i]->take = std::move(output->take);
  });
  for (const std::optional<Error>& error : errors) {
    if (error) return *error;
  }
  return {};
}

const Recorded::Line* Recorded::find(const TestInput& input, const StyleRequest& request) const {
  if (request.strengths.size() != 1) return nullptr;
  const auto& [style, strength] = request.strengths.front();
  const auto found = lines_.find({normal(input.take.row.path), style, strength});
  return found == lines_.end() ? nullptr : &found->second;
}

bool Recorded::can_run(const TestInput& input, const StyleRequest& request) const {
  return find(input, request) != nullptr;
}

Result<RunResult> Recorded::run(const TestInput& input, const StyleRequest& request) const {
  const Line* line = find(input, request);
  if (!line) return Error{name() + ": has no output of " + input.take.row.path};
  line->evaluated = true;
  RunResult run_result;
  run_result.bone_length_error = line->bone_length_error;
  StyledTake& output = run_result.output;
  output.take = line->take;
  const int frames = input.take.frames();
  const bool in_step = std::abs(output.take.frames() - frames) <= 1;
  if (!in_step && !request.timing) {
    return Error{line->where + ": output " + line->output + " lasts " +
                 seconds_text(output.take.frames()) + " and its input " + seconds_text(frames) +
                 "; expected the same, as they are compared frame by frame"};
  }
  if (in_step) {
    set_frames(output.take, frames);
    for (int f = 0; f < frames; ++f) output.source_frames.push_back(static_cast<float>(f));
  }
  output.take.row = input.take.row;
  output.take.row.style = request.style;
  output.take.row.neutral = false;
  return run_result;
}

SystemFacts Recorded::facts() const {
  SystemFacts facts;
  facts.recorded = {lines_.size(), 0};
  for (const auto& [key, line] : lines_) facts.recorded->evaluated += line.evaluated;
  return facts;
}

std::string recorded_requests(const std::vector<ManifestRow>& tests) {
  const auto quoted = [](const std::string& cell) {
    std::string out = "\"";
    for (const char c : cell) out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + "\"";
  };
  std::string csv = "input,style,strength,output\n";
  int count = 0;
  for (const ManifestRow& input : tests) {
    if (!input.neutral) continue;
    std::set<std::string> styles;  // Shown by real takes of the input's own set.
    for (const ManifestRow& row : tests) {
      if (!row.neutral && row.set == input.set) styles.insert(row.style);
    }
    for (const std::string& style : styles) {
      const std::string name = fs::path(input.path).stem().string();
      csv += quoted(input.path) + "," + quoted(style) + ",1," +
             quoted(std::to_string(++count) + "_" + name + "_" + style + ".bvh") + "\n";
    }
  }
  return csv;
}

}  // namespace panache

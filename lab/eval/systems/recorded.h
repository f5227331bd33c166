#pragma once
// Motion files made by another program, so that other systems can be evaluated by their outputs.

#include <atomic>
#include <map>
#include <tuple>

#include "eval/system.h"
#include "takes/manifest.h"

namespace panache {

// The inputs and styles of an evaluation.
struct RecordedScope {
  std::vector<std::string> inputs;  // Paths of takes, as evaluated.
  std::vector<std::string> styles;
};

class Recorded : public System {
 public:
  // Reads `folder`/manifest.csv and all outputs that it lists. Columns: input (the end of exactly
  // one path of `scope`, in whole folder names), style, strength (one of kStrengths) and output (a
  // motion file, relative to the folder, with any skeleton that Rig maps). Errors have the
  // manifest's line.
  static Result<std::unique_ptr<Recorded>> load(const std::string& folder,
                                                const RecordedScope& scope);

  // The name of the system: that of the folder.
  static std::string name_of(const std::string& folder);

  SystemFacts facts() const override;
  std::vector<std::string> styles() const override { return styles_; }
  bool can_run(const TestInput& input, const StyleRequest& request) const override;
  // An output as long as its input is assumed to be synchronous. For others, the source frames are
  // unknown: requests without timing fail, and other results have no source frames. Bone lengths
  // are compared with the output's own first frame.
  Result<RunResult> run(const TestInput& input, const StyleRequest& request) const override;

 private:
  struct Line {
    std::string where;   // "DIR/manifest.csv:3"
    std::string output;  // Path of the file.
    Take take;
    double bone_length_error = 0;  // Metres.
    mutable std::atomic<bool> evaluated = false;
  };
  using Key = std::tuple<std::string, std::string, float>;  // Input, style, strength.

  using System::System;
  Result<void> read_manifest(const std::string& folder, const RecordedScope& scope);
  Result<void> read_outputs();
  const Line* find(const TestInput& input, const StyleRequest& request) const;

  std::map<Key, Line> lines_;
  std::vector<std::string> styles_;
};

// A manifest of all outputs at strength 1 for these takes (test rows, neutral and styled), for
// another program to generate: "input,style,strength,output" and a line each.
std::string recorded_requests(const std::vector<ManifestRow>& tests);

}  // namespace panache

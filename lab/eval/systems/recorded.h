#pragma once
// Motion that another program made, read from files: so systems that are not ours can be judged by
// their own outputs.

#include <atomic>
#include <map>
#include <tuple>

#include "eval/system.h"

namespace panache {

// What the judge can ask for.
struct RecordedScope {
  std::vector<std::string> inputs;  // Paths of takes, as the judge reads them.
  std::vector<std::string> styles;
};

class Recorded : public System {
 public:
  // Reads `folder`/manifest.csv and all outputs that it lists. Columns: input (the end of exactly
  // one path of `scope`, in whole folder names), style, strength (one of kStrengths) and output (a
  // motion file, relative to the folder; any skeleton that Rig maps). Fails with the manifest's
  // line.
  static Result<std::unique_ptr<Recorded>> load(const std::string& folder,
                                                const RecordedScope& scope);

  // The name of the system in a folder: the folder's own.
  static std::string name_of(const std::string& folder);

  SystemFacts facts() const override;
  std::vector<std::string> styles() const override { return styles_; }
  bool can_run(const TestInput& input, const StyleRequest& request) const override;
  // An output as long as its input is taken to be in step with it. Of others nobody knows which
  // instant of the input a frame shows: they fail where the request is without timing, and have no
  // source frames otherwise. Bone lengths are compared with the output's own first frame.
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

// The manifest of all outputs at strength 1 of these takes (test rows, neutral and styled), for
// another program to fill the folder with: "input,style,strength,output" and a line each.
std::string recorded_requests(const std::vector<ManifestRow>& tests);

}  // namespace panache

// Replaces sources whose library is missing in this build; PANACHE_NO_... says which.

#include "fbx.h"
#include "formats.h"
#include "messages.h"
#include "npz.h"
#include "picture.h"
#include "sha256.h"
#include "verbs.h"

namespace panache::cli {
namespace {

[[maybe_unused]] void add_missing(CLI::App& app, int& exit_code, const std::string& name,
                                  const std::string& description, const std::string& message) {
  CLI::App* verb = app.add_subcommand(name, description + " (not in this build)");
  verb->allow_extras();
  verb->callback([&exit_code, message] { exit_code = fail({message}, kBadUsage); });
}

}  // namespace

#ifdef PANACHE_NO_FBX
Result<FbxAsGlb> fbx_to_glb(const std::string& path) {
  return Error{
      path +
      ": this build makes no GLB of FBX files; build with libassimp-dev, or write .fbx or .bvh"};
}
int read_fbx_as_child(const std::string& path) { return fail(fbx_to_glb(path).error(), kBadInput); }
#endif

#ifdef PANACHE_NO_PICTURE
Result<std::string> picture_to_png(const std::string&, const std::string&) {
  return Error{
      "expected PNG or JPEG, found another kind, which this build does not convert; build "
      "with libstb-dev"};
}
int read_picture_as_child(const std::string& path) {
  return fail(picture_to_png("", path).error(), kBadInput);
}
#endif

#ifdef PANACHE_NO_NPZ
Result<std::unique_ptr<MotionFile>> parse_npz(std::string, const std::string& path,
                                              const ReadOptions&) {
  return Error{path + ": this build reads no .npz files; build with libzip-dev"};
}
std::string (*const kWriteNpz)(const Clip&, const std::string&, const Placement&,
                               const SkinnedBody*) = nullptr;
#endif

#ifdef PANACHE_NO_SHA256
std::string sha256_of_file(const std::string&) { return ""; }
#endif

#ifdef PANACHE_NO_MESHOPT
const MeshoptDecoder kMeshoptDecoder = nullptr;
#endif

#ifdef PANACHE_NO_LIVE
void add_live(CLI::App& app, int& exit_code) {
  add_missing(app, exit_code, "live", "Restyle live motion",
              "this build has no live input; build with liblo-dev and libcpp-httplib-dev");
}
#endif

#ifdef PANACHE_NO_VIEW
void add_view(CLI::App& app, int& exit_code) {
  add_missing(app, exit_code, "view", "Show motion in a browser",
              "this build has no server for the page; build with libcpp-httplib-dev, or open "
              "build/web/index.html");
}
#endif

}  // namespace panache::cli

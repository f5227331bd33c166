#include "fbx.h"

#include <algorithm>
#include <memory>

#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/scene.h>

#include "base/file.h"
#include "child_process.h"
#include "fbx_scene.h"
#include "glb.h"
#include "picture.h"

namespace panache::cli {
namespace {

constexpr int kLongestRead = 600;               // Seconds.
constexpr const char* kNoMeshes = "no meshes";  // What the child is told if Assimp has failed.
constexpr const char* kMeshesLeftOut =
    "its meshes are left out, as Assimp cannot read them; exporting it again, as FBX 7 or as GLB, "
    "may help";
constexpr const char* kBreakdown =
    "the FBX reader crashed on it; the file may be damaged; exporting it again, or as GLB, may "
    "help";

// The meshes, skins, materials and pictures of a file; null if Assimp rejects it. Assimp crashes on
// animated pivots, and reads animations even if it is told not to.
std::unique_ptr<aiScene> read_meshes(const std::string& whole, const std::string& path) {
  const Result<std::string> still = fbx_without_motions(whole, path);
  const std::string& bytes = still ? *still : whole;
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_CAMERAS, false);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_LIGHTS, false);
  if (!importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, "fbx")) return nullptr;
  return std::unique_ptr<aiScene>(importer.GetOrphanedScene());
}

// An optional note, a line end, and the GLB.
Result<std::string> convert(const std::string& bytes, bool with_meshes, const std::string& path) {
  const Result<FbxScene> fbx = read_fbx_scene(bytes, path);
  if (!fbx) return fbx.error();
  std::unique_ptr<aiScene> scene;
  if (fbx->has_meshes && with_meshes) scene = read_meshes(bytes, path);
  const bool lacks_meshes = fbx->has_meshes && !scene;
  if (scene) {
    set_nodes(*fbx, *scene);
  } else {
    scene = make_scene(*fbx);
  }
  repair_scene(*fbx, *scene);
  Assimp::Exporter exporter;
  Assimp::ExportProperties properties;
  // In glTF an animated node must not have a matrix.
  properties.SetPropertyBool("GLTF2_NODE_IN_TRS", true);
  const aiExportDataBlob* glb = exporter.ExportToBlob(scene.get(), "glb2", 0, &properties);
  if (!glb) return Error{path + ": cannot be turned into GLB: " + exporter.GetErrorString()};
  const char* const note = lacks_meshes ? kMeshesLeftOut : "";
  return note + ("\n" + std::string(static_cast<const char*>(glb->data), glb->size));
}

}  // namespace

Result<FbxAsGlb> fbx_to_glb(const std::string& path) {
  Result<std::string> bytes = read_file(path);
  if (!bytes) return bytes.error();
  const Result<FbxScene> fbx = read_fbx_scene(*std::move(bytes), path);
  if (!fbx) return fbx.error();
  const auto run = [&](const std::string& input) {
    return run_in_child(kFbxReader, path, input, kBreakdown, kLongestRead);
  };
  Result<std::string> answer = run("");
  // Skeleton and motion need no Assimp.
  if (!answer && fbx->has_meshes) answer = run(kNoMeshes);
  if (!answer) return answer.error();
  const size_t line = std::min(answer->find('\n'), answer->size());
  FbxAsGlb out;
  if (line > 0) out.notes.push_back(path + ": " + answer->substr(0, line));
  out.glb = with_pictures(
      answer->erase(0, line + 1), path,
      [&](const std::string& picture) { return picture_to_png(picture, path); }, out.notes);
  return out;
}

int read_fbx_as_child(const std::string& path) {
  const bool with_meshes = read_input_as_child() != kNoMeshes;
  return answer_as_child(
      path, [&] { return read_file(path); },
      [&](const std::string& bytes) { return convert(bytes, with_meshes, path); }, kLongestRead);
}

}  // namespace panache::cli

#include "fbx.h"

#include <algorithm>
#include <array>
#include <memory>
#include <string_view>

#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/scene.h>

#include "base/file.h"
#include "child_process.h"
#include "fbx_document.h"
#include "fbx_scene.h"
#include "glb.h"
#include "picture.h"

namespace panache::cli {
namespace {

constexpr size_t kLargestFile = size_t{1} << 30;  // Bytes.
constexpr int kLongestRead = 600;                 // Seconds.
constexpr const char* kMeshesLeftOut =
    "its meshes are left out, as only skeletons and motions are read of FBX 6 and of text that "
    "Assimp rejects; Autodesk's FBX Converter makes FBX 7 of it, which keeps them";

bool is_fbx(const std::string& bytes) {
  // Text files begin with a comment or with their first section.
  const std::string start = bytes.substr(0, 4096);
  return start.starts_with("Kaydara FBX Binary") ||
         (start.find("FBX") != std::string::npos && start.find('\0') == std::string::npos);
}

Result<std::string> read_fbx(const std::string& path) {
  Result<std::string> bytes = read_file(path);
  if (!bytes) return bytes.error();
  if (bytes->size() > kLargestFile) {
    return Error{path + ": is larger than 1 GB; expected a smaller FBX file, or the same as GLB"};
  }
  if (!is_fbx(*bytes)) return Error{path + ": does not begin as FBX files do; is it damaged?"};
  return bytes;
}

// Assimp reads FBX 7.1 and later, binary or text.
Result<FbxScene> read_by_assimp(const std::string& bytes, const std::string& path) {
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_CAMERAS, false);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_LIGHTS, false);
  if (importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, "fbx")) {
    return FbxScene{std::unique_ptr<aiScene>(importer.GetOrphanedScene())};
  }
  return Error{path + ": cannot be read as FBX: " + importer.GetErrorString()};
}

// Whether a text file has a version that Assimp does not read.
bool is_old_text(std::string_view bytes) {
  const std::string_view start = bytes.substr(0, 4096);
  return std::ranges::any_of(
      std::array{"; FBX 6", "; FBX 5", "FBXVersion: 6", "FBXVersion: 5"},
      [&](const char* sign) { return start.find(sign) != std::string_view::npos; });
}

// FBX 6, and text that Assimp rejects, yield only a skeleton and motions.
Result<FbxScene> read_scene(const std::string& bytes, const std::string& path) {
  const int version = binary_fbx_version(bytes);
  if (version > 0 && version < 7000) {
    Result<std::string> text = fbx_text_of(bytes, path);
    if (!text) return text.error();
    return fbx_text_scene(*text, path + " (as text)");
  }
  if (is_old_text(bytes)) return fbx_text_scene(bytes, path);
  Result<FbxScene> scene = read_by_assimp(bytes, path);
  if (scene || bytes.starts_with("Kaydara")) return scene;
  // For version 7, Assimp's error message is more detailed.
  Result<FbxScene> read = fbx_text_scene(bytes, path);
  return read && read->scene ? std::move(read) : std::move(scene);
}

// An optional note, a line end, and the GLB.
Result<std::string> convert(const std::string& bytes, const std::string& path) {
  Result<FbxScene> read = read_scene(bytes, path);
  if (!read) return read.error();
  const std::unique_ptr<aiScene>& scene = read->scene;
  if (!scene) return Error{path + ": expected joints (models of FBX), found none"};
  repair_scene(*scene);
  Assimp::Exporter exporter;
  Assimp::ExportProperties properties;
  // In glTF an animated node must not have a matrix.
  properties.SetPropertyBool("GLTF2_NODE_IN_TRS", true);
  const aiExportDataBlob* glb = exporter.ExportToBlob(scene.get(), "glb2", 0, &properties);
  if (!glb) return Error{path + ": cannot be turned into GLB: " + exporter.GetErrorString()};
  const char* const note = read->lacks_meshes ? kMeshesLeftOut : "";
  return note + ("\n" + std::string(static_cast<const char*>(glb->data), glb->size));
}

}  // namespace

Result<FbxAsGlb> fbx_to_glb(const std::string& path) {
  Result<std::string> answer =
      run_in_child(kFbxReader, path, "",
                   "the FBX reader crashed on it; the file may be damaged; "
                   "exporting it again, or as GLB, may help",
                   kLongestRead);
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
  return answer_as_child(
      path, [&] { return read_fbx(path); },
      [&](const std::string& bytes) { return convert(bytes, path); }, kLongestRead);
}

}  // namespace panache::cli

#pragma once
// The models of an FBX document, which include its joints: their hierarchy and transforms.

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/quat.h"
#include "base/result.h"
#include "clip/euler.h"
#include "fbx_document.h"

namespace panache::cli {

// Animated Euler angles in degrees, and lengths in the file's unit.
struct FbxPlace {
  Vec3d translation, rotation;
  Vec3d scale = {1, 1, 1};
};

// A transform relative to the parent: scale, then rotation, then translation.
struct Trs {
  Vec3d translation;
  Quatd rotation;
  Vec3d scale = {1, 1, 1};
};

struct FbxModel {
  std::string name;     // Without "Model::"; unique.
  std::string_view id;  // As used by connections and takes.
  int parent = -1;      // An index smaller than the model's own, or -1.
  FbxPlace place;       // At the time of saving.
  EulerOrder order = {3, {2, 1, 0}};
  Quatd before, after;  // Constant factors left and right of the rotation.
  Vec3d rotation_offset, rotation_pivot, scale_offset, scale_pivot;

  // T Roff Rp Rpre R Rpost^-1 Rp^-1 Soff Sp S Sp^-1, which has no shear.
  Trs trs(const FbxPlace& at) const;
};

// "OO", "OP": child, parent, and for "OP" the parent's property.
struct FbxConnection {
  std::string_view child, parent, property;
};

struct FbxSettings {
  int up_axis = 1, up_sign = 1, side_axis = 0, side_sign = 1;
  double centimetres = 1;  // Per unit.
  double rate = 30;        // Frames a second.
};

std::vector<FbxConnection> fbx_connections(const FbxDocument& document);
Result<FbxSettings> fbx_settings(const FbxDocument& document);

// Parents before children; without childless cameras and lights. Rejects more than 10,000 models,
// more than 500 levels, and cyclic parents.
Result<std::vector<FbxModel>> fbx_models(const FbxDocument& document);

// "Hips" of "Model::Hips".
std::string_view fbx_without_class(std::string_view text);
// `text` as GLB can hold it: at most 200 bytes, with U+FFFD for each byte that is not valid UTF-8,
// as old programs with local encodings wrote.
std::string fbx_name(std::string_view text);

// The values of a property of an object, FBX 6 (`Property:`) or 7 (`P:`), without its name, types
// and flags; null if it is missing.
std::vector<std::string_view> fbx_property(const FbxNode& object, std::string_view name);

}  // namespace panache::cli

#pragma once
// The models of an FBX document, which are its joints among others: their tree and how they stand.

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/quat.h"
#include "base/result.h"
#include "clip/euler.h"
#include "fbx_document.h"

namespace panache::cli {

// The three numbers that curves change, in degrees and in the file's unit.
struct FbxPlace {
  Vec3d translation, rotation;
  Vec3d scale = {1, 1, 1};
};

// A place relative to the parent, as others have it: scaled, then turned, then moved.
struct Trs {
  Vec3d translation;
  Quatd rotation;
  Vec3d scale = {1, 1, 1};
};

struct FbxModel {
  std::string name;     // Without "Model::"; no two have one name.
  std::string_view id;  // By which connections and takes call it.
  int parent = -1;      // An index that is smaller than its own, or none.
  FbxPlace place;       // As the file was written.
  EulerOrder order = {3, {2, 1, 0}};
  Quatd before, after;  // The rotations around the joint's own, as it is.
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
  double centimetres = 1;  // To a unit.
  double rate = 30;        // Frames a second.
};

std::vector<FbxConnection> fbx_connections(const FbxDocument& document);
Result<FbxSettings> fbx_settings(const FbxDocument& document);

// Parents before children; without cameras and lights that nothing hangs on. Rejected are more than
// 10,000 models, more than 500 below each other, and those that are each other's parents.
Result<std::vector<FbxModel>> fbx_models(const FbxDocument& document);

// "Hips" of "Model::Hips".
std::string_view fbx_without_class(std::string_view text);
// `text` as a GLB can hold it: 200 bytes of it at most, and U+FFFD for each that is no UTF-8, as
// programs of one country wrote them.
std::string fbx_name(std::string_view text);

// The values of a property of an object, of FBX 6 (`Property:`) or 7 (`P:`); null where it has
// none. Only those of the property itself, without its name, types and flags.
std::vector<std::string_view> fbx_property(const FbxNode& object, std::string_view name);

}  // namespace panache::cli

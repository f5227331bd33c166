#include <algorithm>

#include "clip/fbx_document.h"

namespace panache {
namespace {

// What skins and stored poses say about the models.
class FbxBindReader {
 public:
  explicit FbxBindReader(FbxDocument& document) : document_(document), tree_(document.tree) {
    for (size_t m = 0; m < document.models.size(); ++m) models_.emplace(document.models[m].id, m);
  }

  void read() {
    for (const FbxNode* node : tree_.in_sections("Objects")) {
      const std::string kind =
          node->values.empty() ? "" : tree_.text(*node, node->values.size() - 1);
      if (node->name == "Deformer" && kind == "Skin")
        skins_.emplace(tree_.text(*node, 0), skins_.size());
      if (node->name == "Deformer" && kind == "Cluster")
        clusters_.emplace(tree_.text(*node, 0), node);
      if (node->name == "Pose" && kind == "BindPose") poses_.push_back(node);
    }
    for (const FbxConnection& connection : document_.connections) {
      const auto skin = skins_.find(connection.parent);
      if (skin != skins_.end()) skin_of_.emplace(connection.child, skin->second);
    }
    for (const FbxConnection& connection : document_.connections) read_cluster(connection);
    for (const FbxNode* pose : poses_) read_pose(*pose);
  }

 private:
  // The joint of a cluster. A skin's word counts more than a pose's, which comes later.
  void read_cluster(const FbxConnection& connection) {
    const auto cluster = clusters_.find(connection.parent);
    const auto model = models_.find(connection.child);
    if (cluster == clusters_.end() || model == models_.end()) return;
    add(model->second, cluster->second->child("TransformLink"));
    const auto skin = skin_of_.find(connection.parent);
    const auto number = skin == skin_of_.end() ? 0 : static_cast<int>(skin->second);
    const auto joint = document_.skins.try_emplace(model->second, number, 0.0f).first;
    std::vector<double> weights;
    if (joint->second.first != number ||
        !tree_.numbers(cluster->second->child("Weights"), weights)) {
      return;
    }
    double sum = 0;
    for (const double weight : weights) sum += weight;
    joint->second.second += static_cast<float>(sum);
  }

  void read_pose(const FbxNode& pose) {
    for (const FbxNode& item : pose.children) {
      const FbxNode* of = item.name == "PoseNode" ? item.child("Node") : nullptr;
      const auto model = of ? models_.find(tree_.text(*of, 0)) : models_.end();
      if (model != models_.end()) add(model->second, item.child("Matrix"));
    }
  }

  void add(size_t model, const FbxNode* matrix) {
    std::vector<double> numbers;
    if (!matrix || !tree_.numbers(matrix, numbers) || numbers.size() != 16) return;
    std::array<double, 16> out;
    std::copy(numbers.begin(), numbers.end(), out.begin());
    document_.bind.emplace(model, out);
  }

  FbxDocument& document_;
  const FbxTree& tree_;
  std::unordered_map<std::string, size_t> models_, skins_, skin_of_;  // By ID.
  std::unordered_map<std::string, const FbxNode*> clusters_;
  std::vector<const FbxNode*> poses_;
};

}  // namespace

void read_fbx_bind(FbxDocument& document) { FbxBindReader(document).read(); }

}  // namespace panache

#include "clip/bvh.h"

#include <utility>

#include "clip/bvh_document.h"

namespace panache {
namespace {

class BvhFile final : public MotionFile {
 public:
  explicit BvhFile(BvhDocument document) : document_(std::move(document)) {}

  const Clip& clip() const override { return document_.clip; }
  std::string encode(const Clip& changed, std::span<const double> source_frames) const override {
    return encode_bvh(document_, changed, source_frames);
  }

 private:
  BvhDocument document_;
};

}  // namespace

Result<std::unique_ptr<MotionFile>> parse_bvh(std::string text, const std::string& name) {
  auto document = read_bvh_document(std::move(text), name);
  if (!document) return document.error();
  return std::unique_ptr<MotionFile>(std::make_unique<BvhFile>(std::move(*document)));
}

}  // namespace panache

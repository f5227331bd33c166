#include "clip/bvh.h"

#include <cassert>
#include <utility>

#include "clip/bvh_document.h"

namespace panache {
namespace {

class BvhFile final : public MotionFile {
 public:
  explicit BvhFile(BvhDocument document) : document_(std::move(document)) {}

  std::vector<std::string> clip_names() const override { return {""}; }
  const Clip& clip(int) const override { return document_.clip; }
  Clip rest() const override { return rest_clip(document_.clip.skeleton); }
  std::vector<std::string> notes() const override { return document_.notes; }
  std::string encode(std::span<const ClipEdit> edits, EditMode) const override {
    if (edits.empty()) return document_.text;
    assert(edits.size() == 1);
    if (edits.front().clip == kNewClip) return format_bvh(*edits.front().changed);
    return encode_bvh(document_, *edits.front().changed, edits.front().source_frames);
  }

 private:
  BvhDocument document_;
};

}  // namespace

Result<std::unique_ptr<MotionFile>> parse_bvh(std::string text, const std::string& name,
                                              const ReadOptions& options) {
  if (options.fps) {
    Result<std::string> corrected = with_bvh_rate(text, name, *options.fps);
    if (!corrected) return corrected.error();
    text = *std::move(corrected);
  }
  auto document = read_bvh_document(std::move(text), name);
  if (!document) return document.error();
  return std::unique_ptr<MotionFile>(std::make_unique<BvhFile>(std::move(*document)));
}

}  // namespace panache

// Model and style files. Half of the mutations are of the header.

#include "framed_json.h"
#include "learn/style_file.h"
#include "net/layer.h"
#include "style/networks/networks.h"
#include "use_motion.h"

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max,
                                          unsigned int seed) {
  using namespace panache::fuzz;
  if (size < 8 || seed % 2 == 0) return LLVMFuzzerMutate(data, size, max);
  const size_t length = std::min<uint64_t>(read_number<uint64_t>(data), size - 8);
  std::string header(reinterpret_cast<char*>(data) + 8, length);
  const std::string rest(reinterpret_cast<char*>(data) + 8 + length, size - 8 - length);
  mutate(header, std::min(max, size + 64) - std::min(max, size) + length);
  return put(bytes_of(static_cast<uint64_t>(header.size())) + header + rest, data, max);
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace panache;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  const Result<TensorFile> file = parse_safetensors(bytes, "in.safetensors");
  if (!file) return 0;
  const Result<TensorFile> again = parse_safetensors(format_safetensors(*file), "again");
  if (!again) fuzz::fail("what was written cannot be read: " + again.error().message);
  static const TensorFile whole = test::make_model({"old", "proud"});
  if (is_style_file(*file)) {
    static_cast<void>(add_style(whole, "model", *file, "style", true));
    return 0;
  }
  const Result<std::shared_ptr<const Model>> model = Model::create(*file, "in.safetensors");
  if (!model) return 0;
  StyleNetworks networks(*model);
  const std::vector<float> strengths((*model)->styles().size(), 1.0f);
  networks.set_strengths(strengths);
  const std::vector<float> window(
      size_t(kWindowPoses) * pose_feature_count((*model)->recipe().layout), 0.5f);
  networks.forward(window, 0.5f);
  if (!(*model)->styles().empty()) {
    static_cast<void>(extract_style(*file, (*model)->styles().front().name, "in"));
  }
  return 0;
}

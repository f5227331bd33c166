// The arrays of an .npz, one behind the other, each after its length (4 bytes): the archive around
// them is libzip's.

#include "clip/smpl.h"
#include "framed_json.h"
#include "use_motion.h"

namespace {

using panache::NpzMember;

std::string pack(const std::vector<NpzMember>& members) {
  std::string bytes;
  for (const NpzMember& member : members) {
    bytes += panache::fuzz::bytes_of(static_cast<uint32_t>(member.bytes.size())) + member.bytes;
  }
  return bytes;
}

panache::Result<std::unique_ptr<panache::MotionFile>> parse(std::string bytes,
                                                            const std::string& name) {
  std::vector<NpzMember> members;
  for (const char* array : {"poses", "trans", "mocap_framerate", "betas", "gender", "dmpls"}) {
    if (bytes.size() < 4) break;
    const auto* data = reinterpret_cast<const uint8_t*>(bytes.data());
    const size_t size =
        std::min<size_t>(panache::fuzz::read_number<uint32_t>(data), bytes.size() - 4);
    members.push_back({std::string(array) + ".npy", bytes.substr(4, size)});
    bytes.erase(0, 4 + size);
  }
  return panache::parse_smpl(std::move(members), bytes, pack, name);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  // What is written may have its arrays in another order, so it is not read again.
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  panache::Result<std::unique_ptr<panache::MotionFile>> file = parse(bytes, "in.npz");
  if (!file) return 0;
  const panache::Clip& clip = (*file)->clip();
  if (clip.frames > 120) return 0;
  panache::Clip changed = clip;
  for (panache::Quat& q : changed.rotations) q = panache::Quat{};
  std::vector<double> frames;
  for (int f = 0; f < clip.frames; ++f) frames.push_back(f);
  (*file)->encode(changed, frames);
  return 0;
}

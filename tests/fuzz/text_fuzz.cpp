// Tables, joint maps and what a tracker sends. The first byte says which.

#include <fstream>

#include "base/csv.h"
#include "rig_options.h"
#include "strengths.h"
#include "temporary_folder.h"
#include "use_motion.h"
#ifdef PANACHE_VMC
#include "vmc_messages.h"
#endif

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace panache;
  if (size == 0) return 0;
  const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  static const test::TemporaryFolder folder;
  const std::string path = folder.path() + "table.csv";
  switch (data[0] % 4) {
    case 0:
      static_cast<void>(cli::parse_joint_map(text, "map.json"));
      return 0;
    case 1: {
#ifdef PANACHE_VMC
      std::vector<char> datagram(text.begin(), text.end());
      const auto messages = cli::read_vmc(datagram);
      if (!messages) return 0;
      for (const cli::VmcMessage& message : *messages) {
        if (message.kind != cli::VmcMessage::bone) continue;
        cli::put_position(datagram, message.offset, message.position);
        cli::put_rotation(datagram, message.offset, message.rotation);
      }
      if (!cli::read_vmc(datagram)) fuzz::fail("what was changed in place cannot be read");
#endif
      return 0;
    }
    case 2:
      std::ofstream(path, std::ios::binary) << text;
      static_cast<void>(read_csv(path));
      static_cast<void>(read_csv(path, {"path", "style"}));
      return 0;
    default:
      std::ofstream(path, std::ios::binary) << text;
      static_cast<void>(cli::read_strengths(path, *fuzz::small_model()));
      return 0;
  }
}

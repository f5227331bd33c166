#include "eval/systems/table.h"

#include <algorithm>

#include "base/text.h"
#include "eval/systems/holden2017/holden2017.h"
#include "eval/systems/xia2015/xia2015.h"
#include "eval/systems/yumer2016/yumer2016.h"

namespace panache {
namespace {

template <typename Published>
Result<std::unique_ptr<System>> make(const std::string& name, const SystemData& data) {
  auto made = Published::create(name, data);
  if (!made) return made.error();
  return std::unique_ptr<System>(std::move(*made));
}

}  // namespace

const std::vector<SystemEntry>& published_systems() {
  static const std::vector<SystemEntry> systems = {
      {"xia2015", make<Xia2015>},
      {"yumer2016", make<Yumer2016>},
      {"holden2017", make<Holden2017>},
  };
  return systems;
}

Result<std::vector<SystemEntry>> find_published(const std::vector<std::string>& names) {
  std::vector<std::string> known = {"all"};
  for (const SystemEntry& entry : published_systems()) known.push_back(entry.name);
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      return Error{"no system '" + name + "'; expected " + one_of(known)};
    }
  }
  std::vector<SystemEntry> found;
  for (const SystemEntry& entry : published_systems()) {
    const auto asked = [&](const char* name) {
      return std::find(names.begin(), names.end(), name) != names.end();
    };
    if (asked("all") || asked(entry.name)) found.push_back(entry);
  }
  return found;
}

}  // namespace panache

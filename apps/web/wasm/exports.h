#pragma once
// What only the page needs beside panache.h, which the module exports whole: functions of numbers
// and addresses, with the prefix panache_page_. Who creates a thing frees it. A function that fails
// gives null, and panache_last_error() says why.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "api/errors.h"
#include "api/objects.h"
#include "base/result.h"
#include "clip/motion_file.h"
#include "walker/walker_model.h"

#define PANACHE_EXPORT extern "C" __attribute__((visibility("default"), used))

namespace panache::web {

using WalkerHandle = std::shared_ptr<const WalkerModel>;
using FileHandle = std::shared_ptr<const MotionFile>;

// Failure is reported as null.
inline std::nullptr_t fail(const Error& error) {
  api::fail(PANACHE_BAD_ARGUMENT, error);
  return nullptr;
}

// Names are those of files, and may be no UTF-8.
inline panache_bytes* to_bytes(const nlohmann::json& json) {
  return new panache_bytes{json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)};
}

inline std::string_view bytes_at(const char* data, uint32_t size) { return {data, size}; }

}  // namespace panache::web

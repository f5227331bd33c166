#pragma once
// Functions for the page in addition to panache.h, which the module exports in full. They take
// numbers and addresses and have the prefix panache_page_. The caller frees what it creates. On
// failure they return null, and panache_last_error() says why.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "api/errors.h"
#include "api/objects.h"
#include "base/result.h"
#include "walker/walker_model.h"

#define PANACHE_EXPORT extern "C" __attribute__((visibility("default"), used))

namespace panache::web {

using WalkerHandle = std::shared_ptr<const WalkerModel>;

// Stores the error and returns null.
inline std::nullptr_t fail(const Error& error) {
  api::fail(PANACHE_BAD_ARGUMENT, error);
  return nullptr;
}

// Names come from files and may not be valid UTF-8.
inline panache_bytes* to_bytes(const nlohmann::json& json) {
  return new panache_bytes{json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)};
}

inline std::string_view bytes_at(const char* data, uint32_t size) { return {data, size}; }

}  // namespace panache::web

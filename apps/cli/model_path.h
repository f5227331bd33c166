#pragma once
// Where the models are that come with the program.

#include <string>

#include "base/result.h"

namespace panache::cli {

inline constexpr const char* kDefaultModel = "panache-int8.safetensors";
inline constexpr const char* kFloatModel = "panache.safetensors";  // The default as floats.
inline constexpr const char* kRemoverModel = "remover-int8.safetensors";
inline constexpr const char* kNeutralBank = "neutral.safetensors";
inline constexpr const char* kWalkerModel = "walker.safetensors";

// The path of the shipped model called `file_name`: in share/panache/models beside an installed
// program's folder, in models/ beside the program, or in models/ of the checkout that it was built
// in. The message of a failure lists where it was looked for.
Result<std::string> find_shipped(const std::string& file_name);

// The path of the model to use: `given` (--model) if not empty, else the one that the environment
// variable PANACHE_MODEL names, else the shipped one called `file_name`. Nothing is read yet.
Result<std::string> find_model(const std::string& given,
                               const std::string& file_name = kDefaultModel);

}  // namespace panache::cli

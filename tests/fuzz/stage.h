#pragma once
// A model and a skeleton of the C interface, for characters that share them.

#include "character_calls.h"
#include "make_model.h"
#include "net/safetensors.h"

namespace panache::fuzz {

struct Stage {
  panache_model* model = nullptr;
  panache_skeleton* skeleton = nullptr;
  Stage() {
    const std::string bytes = format_safetensors(test::make_model({"old", "proud"}));
    check(panache_model_create(bytes.data(), bytes.size(), &model) == PANACHE_OK, "no model");
    check(panache_skeleton_create(stick_figure, STICK_JOINTS, nullptr, &skeleton) == PANACHE_OK,
          "no skeleton");
  }
};

}  // namespace panache::fuzz

// A character of the C interface: calls in any order, poses and times of any bits.

#include <fuzzer/FuzzedDataProvider.h>

#include "stage.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
  static const panache::fuzz::Stage stage;
  FuzzedDataProvider data(bytes, size);
  panache::fuzz::call_in_any_order(stage.model, stage.skeleton, data);
  return 0;
}

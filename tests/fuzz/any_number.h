#pragma once
// Numbers that nobody expects.

#include <cstdint>
#include <cstring>
#include <limits>

namespace panache::fuzz {

// Any number, the odd ones often. `data` is a FuzzedDataProvider or has its names.
template <class Data>
float any_number(Data& data) {
  constexpr float kOdd[] = {0,
                            -0.0f,
                            1,
                            std::numeric_limits<float>::infinity(),
                            -std::numeric_limits<float>::infinity(),
                            std::numeric_limits<float>::quiet_NaN(),
                            std::numeric_limits<float>::denorm_min(),
                            std::numeric_limits<float>::max(),
                            -std::numeric_limits<float>::max(),
                            1e9f,
                            -1e-9f};
  if (data.ConsumeBool()) return data.PickValueInArray(kOdd);
  const auto bits = data.template ConsumeIntegral<uint32_t>();
  float number;
  std::memcpy(&number, &bits, sizeof number);
  return number;
}

}  // namespace panache::fuzz

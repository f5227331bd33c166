// Three characters of one model and one skeleton, each in a thread of its own: calls in any order.
// Each moves as it does alone.

#include <array>
#include <latch>
#include <thread>
#include <vector>

#include <fuzzer/FuzzedDataProvider.h>

#include "stage.h"

namespace {

constexpr size_t kThreads = 3;

// The character whose calls are told by the part `which` of the bytes.
uint64_t animate(const uint8_t* bytes, size_t size, size_t which) {
  static const panache::fuzz::Stage stage;
  const size_t part = size / kThreads;
  FuzzedDataProvider data(bytes + which * part, part);
  return panache::fuzz::call_in_any_order(stage.model, stage.skeleton, data);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
  std::array<uint64_t, kThreads> beside{};
  std::latch together(kThreads);
  std::vector<std::thread> threads;
  for (size_t i = 0; i < kThreads; ++i) {
    threads.emplace_back([&, i] {
      together.arrive_and_wait();
      beside[i] = animate(bytes, size, i);
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (size_t i = 0; i < kThreads; ++i) {
    panache::fuzz::check(beside[i] == animate(bytes, size, i),
                         "a character moves otherwise beside others than alone");
  }
  return 0;
}

#include "train/matrix_products.h"

#include <algorithm>
#include <cstdlib>
#include <string>
#include <thread>

#include <dlfcn.h>
#include <ATen/Parallel.h>

#include "base/parallel.h"

namespace panache {
namespace {

constexpr size_t kBuffer = size_t{128} << 20;

}  // namespace

Result<void> prepare_matrix_products() {
  at::set_num_threads(1);
  // OpenBLAS has its own function for this, which exists only if libtorch uses OpenBLAS.
  using SetThreads = void (*)(int);
  void* found = ::dlsym(RTLD_DEFAULT, "openblas_set_num_threads");
  if (!found) return {};
  reinterpret_cast<SetThreads>(found)(1);

  // Classifiers are trained two at a time, each with as many threads as there are cores.
  const int threads = 2 * static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  const size_t room = (static_cast<size_t>(threads) + 2) * kBuffer;  // Two for everything after.
  void* volatile probe = std::malloc(room);  // Keeps compilers from removing it.
  const bool fits = probe != nullptr;
  std::free(probe);
  if (!fits) {
    return Error{"training and evaluation need " + std::to_string(room >> 20) +
                 " MB more memory for products of matrices than there is; allow them more"};
  }
  // Products long enough to occupy all threads at the same time.
  const auto multiply = [](int) {
    const torch::NoGradGuard no_gradients;
    const torch::Tensor numbers = torch::zeros({512, 512});
    for (int i = 0; i < 16; ++i) torch::mm(numbers, numbers);
  };
  parallel_for(threads, multiply, threads);
  return {};
}

}  // namespace panache

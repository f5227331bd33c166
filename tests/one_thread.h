#pragma once
// Keeps the libraries below libtorch from starting threads of their own: several classifiers learn
// side by side, each on its thread, and would wait for each other's.

#include <dlfcn.h>

#include <torch/torch.h>

namespace panache::test {

inline void keep_libraries_single_threaded() {
  torch::set_num_threads(1);
  using SetThreads = void (*)(int);
  if (void* found = ::dlsym(RTLD_DEFAULT, "openblas_set_num_threads")) {
    reinterpret_cast<SetThreads>(found)(1);
  }
}

}  // namespace panache::test

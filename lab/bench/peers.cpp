#include "bench/peers.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <dlfcn.h>

#include "bench/onnxruntime.h"

namespace panache::bench {
namespace {

namespace fs = std::filesystem;

constexpr struct {
  const char *key, *name, *library;
  bool int8 = false;
} kPeers[] = {{"eigen", "Eigen", "eigen"},
              {"openblas", "OpenBLAS", "openblas"},
              {"onednn", "oneDNN", "onednn"},
              {"onednn_int8", "oneDNN, int8", "onednn", true},
              {"onnxruntime", "ONNX Runtime", "onnxruntime"},
              {"onnxruntime_int8", "ONNX Runtime, int8", "onnxruntime", true},
              {"libtorch", "libtorch", "libtorch"}};
// Outputs have a magnitude of 1; sums of some hundred products in another order differ by a few
// units of float precision.
constexpr float kMaxDifference = 1e-4f;
// Weights in steps of 1/127 of their column's largest (below 3.5 deviations) and inputs in 255
// steps of their range (about 6.5 deviations) each have an error of 0.8 percent of a deviation,
// 0.29 steps. A layer adds both to the error of its outputs; over four layers that is 2 * 2 * 1.1
// percent. Five times as much never occurs.
constexpr float kMaxInt8Difference = 0.23f;

std::string folder_beside_program() {
  std::error_code status;
  return fs::read_symlink("/proc/self/exe", status).parent_path() / "bench";
}

bool machine_has(const std::string& flag) {
  std::ifstream file("/proc/cpuinfo");
  for (std::string word; file >> word;) {
    if (word == flag) return true;
  }
  return false;
}

// Opens the module at `path`, never to be closed.
std::unique_ptr<Evaluation> open_module(const std::string& path, std::span<const Network> networks,
                                        bool int8, std::string& problem) {
  void* module = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!module) {
    problem = ::dlerror();
    return nullptr;
  }
  const auto make = reinterpret_cast<decltype(&panache_bench_peer)>(
      ::dlsym(module, int8 ? "panache_bench_peer_int8" : "panache_bench_peer"));
  if (!make) {
    problem = path + " is no module of panache-lab bench";
    return nullptr;
  }
  return std::unique_ptr<Evaluation>(make(networks.data(), networks.size(), &problem));
}

// Returns a message if the evaluation differs too much from our own loops.
std::string check(Evaluation& evaluation, std::span<const Network> networks, bool int8) {
  const float max_difference = int8 ? kMaxInt8Difference : kMaxDifference;
  for (const uint64_t seed : {11, 12, 13}) {
    const std::vector<float> x = random_numbers(kSlidesInputs, seed);
    std::vector<float> wanted(kSlidesOutputs), found(kSlidesOutputs);
    run_plainly(networks, x, wanted);
    evaluation.run(x, found);
    for (size_t i = 0; i < wanted.size(); ++i) {
      if (std::abs(wanted[i] - found[i]) <= max_difference) continue;
      return "gives " + std::to_string(found[i]) + " for output " + std::to_string(i) +
             "; expected " + std::to_string(wanted[i]);
    }
  }
  return "";
}

// Returns whether the variable has changed.
bool set_variable(const char* name, const std::string& value) {
  const char* const old = ::getenv(name);
  if (old && old == value) return false;
  ::setenv(name, value.c_str(), 1);
  return true;
}

}  // namespace

// One thread each. OpenBLAS takes some newer machines for much older ones; so this selects its
// AVX-512 kernels if the machine has AVX-512.
bool set_environment() {
  bool is_changed = false;
  for (const char* threads : {"OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"}) {
    if (!::getenv(threads)) is_changed |= set_variable(threads, "1");
  }
  if (machine_has("avx512dq") && machine_has("avx512bw") && machine_has("avx512vl")) {
    is_changed |= set_variable("OPENBLAS_CORETYPE", "SkylakeX");
  }
  return is_changed;
}

std::vector<Peer> make_peers(std::span<const Network> networks, const std::string& given) {
  set_environment();
  const std::string folder = given.empty() ? folder_beside_program() : given;
  std::vector<Peer> peers;
  for (const auto& [key, name, library, int8] : kPeers) {
    Peer peer{key, name, nullptr, ""};
    const bool onnx = std::string_view(library) == "onnxruntime";
    const std::string path =
        folder + (onnx ? "/libonnxruntime.so.1" : "/peer_" + std::string(library) + ".so");
    if (!fs::exists(path)) {
      peer.missing = "not installed";
    } else {
      peer.evaluation = onnx ? open_onnxruntime(path, networks, int8, peer.missing)
                             : open_module(path, networks, int8, peer.missing);
    }
    if (peer.evaluation) peer.missing = check(*peer.evaluation, networks, int8);
    if (!peer.missing.empty()) peer.evaluation.reset();
    peers.push_back(std::move(peer));
  }
  return peers;
}

}  // namespace panache::bench

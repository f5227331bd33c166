#pragma once
// The same networks in other libraries, if these are installed.
// Each library has its own module in the folder `bench` next to the program, which only
// `panache-lab bench` opens. So the measured program is the one that is used, settings are made
// before the libraries start, and a single module may be compiled for this machine.

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bench/networks.h"

namespace panache::bench {

struct Peer {
  std::string key;                         // Key in forward_pass_us: "onnxruntime".
  std::string name;                        // For display: "ONNX Runtime".
  std::unique_ptr<Evaluation> evaluation;  // Null if it is missing; then
  std::string missing;                     // the reason.
};

// Sets environment variables that ask these libraries for one thread and this machine's kernels.
// Returns whether they have changed: libraries already loaded have read the old ones.
bool set_environment();

// All known libraries, opened from `folder` (by default `bench` next to the program) and checked
// against our own loops. Calls set_environment().
std::vector<Peer> make_peers(std::span<const Network> networks, const std::string& folder = "");

// The entry point of a module: makes the evaluation, or returns null and a message.
extern "C" Evaluation* panache_bench_peer(const Network* networks, size_t count,
                                          std::string* problem);
// The same in int8, if the library supports it.
extern "C" Evaluation* panache_bench_peer_int8(const Network* networks, size_t count,
                                               std::string* problem);

}  // namespace panache::bench

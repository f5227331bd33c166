#pragma once
// The same networks in the libraries of others, each where it is installed.
//
// Each library is in a module of its own beside the program, in the folder `bench`, opened only by
// `panache-lab bench`: so the program that is measured is the program that is used, their settings
// are made before they start, and one may be compiled for this very machine without the others.

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bench/networks.h"

namespace panache::bench {

struct Peer {
  std::string key;                         // As in forward_pass_us: "onnxruntime".
  std::string name;                        // For people: "ONNX Runtime".
  std::unique_ptr<Evaluation> evaluation;  // Null where it is missing; then
  std::string missing;                     // why.
};

// Sets the environment that asks these libraries for a single thread and the kernels of this
// machine. Returns whether that changes it: libraries loaded before have read the old one.
bool set_environment();

// All that we know of, ready where they are there: found in `folder` (by default the folder `bench`
// beside the program), and checked to give what our own loops give. Calls set_environment().
std::vector<Peer> make_peers(std::span<const Network> networks, const std::string& folder = "");

// What a module has instead: makes the evaluation, or returns null and says why.
extern "C" Evaluation* panache_bench_peer(const Network* networks, size_t count,
                                          std::string* problem);
// The same in int8, where the library has that.
extern "C" Evaluation* panache_bench_peer_int8(const Network* networks, size_t count,
                                               std::string* problem);

}  // namespace panache::bench

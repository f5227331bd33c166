#include "bench/onnxruntime.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include <dlfcn.h>

#include "bench/onnx_file.h"

namespace panache::bench {
namespace {

// The C interface is a table of functions with a stable order; the indices below are those of its
// first version. All objects are opaque pointers.
using Handle = void*;
using Status = void*;  // Null on success.

enum Function : size_t {
  kGetErrorMessage = 2,
  kCreateEnv = 3,
  kCreateSessionFromArray = 8,
  kRun = 9,
  kCreateSessionOptions = 10,
  kSetSessionExecutionMode = 13,
  kSetSessionGraphOptimizationLevel = 23,
  kSetIntraOpNumThreads = 24,
  kCreateTensorWithDataAsOrtValue = 49,
  kCreateCpuMemoryInfo = 69,
  kReleaseEnv = 92,
  kReleaseStatus = 93,
  kReleaseMemoryInfo = 94,
  kReleaseSession = 95,
  kReleaseValue = 96,
  kReleaseSessionOptions = 100,
};
constexpr uint32_t kVersion = 1;
constexpr int kWarnings = 2, kSequential = 0, kAllOptimisations = 99;
constexpr int kArenaAllocator = 1, kDefaultMemory = 0, kFloat = 1;

struct Base {
  void* const* (*get_functions)(uint32_t version);
  const char* (*get_version)();
};

class OnnxRuntime : public Evaluation {
 public:
  OnnxRuntime(const Base& base, std::span<const Network> networks, bool int8)
      : functions_(base.get_functions(kVersion)),
        version_(base.get_version()),
        int8_(int8),
        x_(kSlidesInputs),
        y_(kSlidesOutputs) {
    if (!functions_) {
      problem_ = "ONNX Runtime " + version_ + " has no interface of version 1";
      return;
    }
    const std::string file = format_onnx(networks, int8_);
    Handle options = nullptr;
    call<int, const char*, Handle*>(kCreateEnv, kWarnings, "panache", &environment_);
    call<Handle*>(kCreateSessionOptions, &options);
    call<Handle, int>(kSetSessionExecutionMode, options, kSequential);
    call<Handle, int>(kSetSessionGraphOptimizationLevel, options, kAllOptimisations);
    call<Handle, int>(kSetIntraOpNumThreads, options, 1);
    call<Handle, const void*, size_t, Handle, Handle*>(
        kCreateSessionFromArray, environment_, file.data(), file.size(), options, &session_);
    call<int, int, Handle*>(kCreateCpuMemoryInfo, kArenaAllocator, kDefaultMemory, &memory_);
    release(kReleaseSessionOptions, options);
    input_ = tensor(x_);
    std::span<float> rest = y_;
    for (const Network& network : networks) {
      const size_t size = network.layers.back().bias.size();
      outputs_.push_back(tensor(rest.first(size)));
      rest = rest.subspan(size);
      output_names_.push_back("y" + std::to_string(output_names_.size()));
    }
    for (const std::string& name : output_names_) output_name_pointers_.push_back(name.c_str());
  }
  ~OnnxRuntime() override {
    for (const Handle output : outputs_) release(kReleaseValue, output);
    release(kReleaseValue, input_);
    release(kReleaseSession, session_);
    release(kReleaseMemoryInfo, memory_);
    release(kReleaseEnv, environment_);
  }
  OnnxRuntime(const OnnxRuntime&) = delete;
  OnnxRuntime& operator=(const OnnxRuntime&) = delete;

  void run(std::span<const float> x, std::span<float> y) override {
    std::copy(x.begin(), x.end(), x_.begin());
    const char* input_name = "x";
    call<Handle, Handle, const char* const*, const Handle*, size_t, const char* const*, size_t,
         Handle*>(kRun, session_, nullptr, &input_name, &input_, 1, output_name_pointers_.data(),
                  outputs_.size(), outputs_.data());
    std::copy(y_.begin(), y_.end(), y.begin());
  }
  std::string library() const override {
    return "ONNX Runtime " + version_ + (int8_ ? ", int8" : "");
  }
  const std::string& problem() const { return problem_; }

 private:
  // Calls the function at an index of the table, unless an earlier call has failed.
  template <class... Arguments>
  void call(Function which, Arguments... arguments) {
    if (!problem_.empty()) return;
    const auto function = reinterpret_cast<Status (*)(Arguments...)>(functions_[which]);
    const Status status = function(arguments...);
    if (!status) return;
    const auto message = reinterpret_cast<const char* (*)(Status)>(functions_[kGetErrorMessage]);
    problem_ = message(status);
    release(kReleaseStatus, status);
  }
  void release(Function which, Handle handle) {
    if (handle) reinterpret_cast<void (*)(Handle)>(functions_[which])(handle);
  }
  Handle tensor(std::span<float> numbers) {
    const int64_t shape[] = {1, static_cast<int64_t>(numbers.size())};
    Handle value = nullptr;
    call<Handle, void*, size_t, const int64_t*, size_t, int, Handle*>(
        kCreateTensorWithDataAsOrtValue, memory_, numbers.data(), numbers.size_bytes(), shape, 2,
        kFloat, &value);
    return value;
  }

  void* const* functions_;
  std::string version_, problem_;
  bool int8_;
  std::vector<float> x_, y_;
  Handle environment_ = nullptr, session_ = nullptr, memory_ = nullptr, input_ = nullptr;
  std::vector<Handle> outputs_;
  std::vector<std::string> output_names_;
  std::vector<const char*> output_name_pointers_;
};

}  // namespace

std::unique_ptr<Evaluation> open_onnxruntime(const std::string& path,
                                             std::span<const Network> networks, bool int8,
                                             std::string& problem) {
  void* library = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!library) {
    problem = ::dlerror();
    return nullptr;
  }
  const auto get_base = reinterpret_cast<const Base* (*)()>(::dlsym(library, "OrtGetApiBase"));
  if (!get_base) {
    problem = path + " is no ONNX Runtime";
    return nullptr;
  }
  auto evaluation = std::make_unique<OnnxRuntime>(*get_base(), networks, int8);
  problem = evaluation->problem();
  if (!problem.empty()) return nullptr;
  return evaluation;
}

}  // namespace panache::bench

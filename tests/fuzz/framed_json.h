#pragma once
// Mutations of a text that stands in a binary frame with its length: bytes alone rarely keep that.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t most);

namespace panache::fuzz {

// Changes `text` as libFuzzer would, to at most `most` bytes.
inline void mutate(std::string& text, size_t most) {
  const size_t size = text.size();
  text.resize(std::max(size, most));
  text.resize(LLVMFuzzerMutate(reinterpret_cast<uint8_t*>(text.data()), size, text.size()));
}

// Puts `bytes` in the place of the input; what does not fit is left out.
inline size_t put(const std::string& bytes, uint8_t* data, size_t most) {
  const size_t size = std::min(bytes.size(), most);
  std::memcpy(data, bytes.data(), size);
  return size;
}

template <class T>
T read_number(const uint8_t* data) {
  T number;
  std::memcpy(&number, data, sizeof number);
  return number;
}
template <class T>
std::string bytes_of(T number) {
  return {reinterpret_cast<const char*>(&number), sizeof number};
}

}  // namespace panache::fuzz

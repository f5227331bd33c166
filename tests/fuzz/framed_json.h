#pragma once
// Mutations of a text that stands in a binary frame with its length: bytes alone rarely keep that.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t max);

namespace panache::fuzz {

// Changes `text` as libFuzzer would, to at most `max` bytes.
inline void mutate(std::string& text, size_t max) {
  const size_t size = text.size();
  text.resize(std::max(size, max));
  text.resize(LLVMFuzzerMutate(reinterpret_cast<uint8_t*>(text.data()), size, text.size()));
}

// Puts `bytes` in the place of the input; what does not fit is left out.
inline size_t put(const std::string& bytes, uint8_t* data, size_t max) {
  const size_t size = std::min(bytes.size(), max);
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

// The same for a GLB: half of its mutations are of the JSON inside, with lengths kept right.
inline size_t mutate_glb(uint8_t* data, size_t size, size_t max, unsigned int seed) {
  constexpr size_t kHeader = 20;  // Of the file and of its first chunk.
  if (size < kHeader || std::memcmp(data, "glTF", 4) != 0 || seed % 2 == 0) {
    return LLVMFuzzerMutate(data, size, max);
  }
  const size_t length = std::min<size_t>(read_number<uint32_t>(data + 12), size - kHeader);
  std::string json(reinterpret_cast<char*>(data) + kHeader, length);
  const std::string rest(reinterpret_cast<char*>(data) + kHeader + length, size - kHeader - length);
  mutate(json, std::min(max, size + 64) - std::min(max, size) + length);
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::string file = "glTF" + bytes_of<uint32_t>(2) +
                           bytes_of(static_cast<uint32_t>(kHeader + json.size() + rest.size())) +
                           bytes_of(static_cast<uint32_t>(json.size())) + "JSON" + json + rest;
  return put(file, data, max);
}

}  // namespace panache::fuzz

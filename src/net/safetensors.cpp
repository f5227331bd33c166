#include "net/safetensors.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

#include <nlohmann/json.hpp>

#include "base/bytes.h"

namespace panache {
namespace {

constexpr size_t kLengthBytes = 8;
// A model's header is a few kilobytes; this bounds the memory that a hostile one takes.
constexpr uint64_t kMaxHeaderBytes = 4 << 20;
constexpr size_t kMaxDimensions = 8;

struct Entry {
  std::string name;
  std::string type;
  std::vector<uint64_t> shape;
  std::vector<uint64_t> offsets;  // [begin, end) in the data, bytes.
  std::set<std::string> fields;   // Those of the above that were read so far.
};

// Text from the file for a message: short and without control characters.
std::string printable(std::string_view text) {
  constexpr size_t kLongest = 80;
  size_t length = std::min(text.size(), kLongest);
  // Not in the middle of a UTF-8 character.
  while (length < text.size() && (text[length] & 0xc0) == 0x80) ++length;
  std::string out;
  for (const char c : text.substr(0, length)) {
    out += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  }
  return length < text.size() ? out + "..." : out;
}

std::string in_quotes(std::string_view text) {
  std::string out = "'";
  out += printable(text);
  return out += '\'';
}

template <class Size>
std::string shape_text(const std::vector<Size>& shape) {
  std::string text = "[";
  for (const Size size : shape) {
    text += (text.size() > 1 ? ", " : "") +
            (std::is_signed_v<Size> && size == Size(-1) ? "any" : std::to_string(size));
  }
  return text + "]";
}

// Parses the header's JSON as a stream, so that neither depth nor repetition costs memory. Anything
// that a header may not contain ends the parsing with a message.
class HeaderReader : public nlohmann::json_sax<nlohmann::json> {
 public:
  std::map<std::string, std::string> metadata;
  std::vector<Entry> entries;
  std::string problem;  // Without the file's name.

  bool null() override { return unexpected(); }
  bool boolean(bool) override { return unexpected(); }
  bool number_integer(number_integer_t) override { return unexpected(); }
  bool number_float(number_float_t, const string_t&) override { return unexpected(); }
  bool binary(binary_t&) override { return unexpected(); }

  bool number_unsigned(number_unsigned_t value) override {
    if (in_ != In::numbers) return unexpected();
    if (numbers_->size() == kMaxDimensions) {
      return fail("tensor " + in_quotes(entries.back().name) + ": " + field_ + " has more than " +
                  std::to_string(kMaxDimensions) + " numbers");
    }
    numbers_->push_back(value);
    return true;
  }

  bool string(string_t& text) override {
    if (in_ == In::metadata) {
      metadata[key_] = text;
      return true;
    }
    if (in_ != In::tensor || field_ != "dtype") return unexpected();
    entries.back().type = text;
    return true;
  }

  bool start_object(size_t) override {
    if (in_ == In::outside) {
      in_ = In::header;
    } else if (in_ == In::header && key_ == "__metadata__") {
      in_ = In::metadata;
    } else if (in_ == In::header) {
      in_ = In::tensor;
      entries.push_back({key_, {}, {}, {}, {}});
    } else {
      return unexpected();
    }
    return true;
  }

  bool key(string_t& text) override {
    if (in_ == In::tensor) return tensor_key(text);
    key_ = text;
    const bool first = in_ == In::header ? names_.insert(text).second : !metadata.contains(text);
    const char* what = in_ == In::header ? "the header has tensor " : "the header has metadata ";
    return first || fail(what + in_quotes(text) + " twice");
  }

  bool end_object() override {
    if (in_ == In::tensor) {
      const Entry& entry = entries.back();
      if (entry.fields.size() != 3) {
        return fail("tensor " + in_quotes(entry.name) +
                    " is described in part; expected dtype, shape and data_offsets");
      }
    }
    in_ = in_ == In::header ? In::outside : In::header;
    return true;
  }

  bool start_array(size_t) override {
    if (in_ != In::tensor || field_ == "dtype") return unexpected();
    Entry& entry = entries.back();
    numbers_ = field_ == "shape" ? &entry.shape : &entry.offsets;
    in_ = In::numbers;
    return true;
  }

  bool end_array() override {
    in_ = In::tensor;
    if (field_ == "data_offsets" && numbers_->size() != 2) {
      return fail("tensor " + in_quotes(entries.back().name) + ": data_offsets has " +
                  std::to_string(numbers_->size()) + " numbers; expected 2");
    }
    return true;
  }

  bool parse_error(size_t position, const std::string&,
                   const nlohmann::detail::exception&) override {
    return fail("the header is not JSON from its byte " + std::to_string(position) + " on");
  }

 private:
  enum class In { outside, header, metadata, tensor, numbers };

  bool fail(std::string message) {
    problem = std::move(message);
    return false;
  }

  bool tensor_key(const std::string& text) {
    Entry& entry = entries.back();
    const bool known = text == "dtype" || text == "shape" || text == "data_offsets";
    if (!known) {
      return fail("tensor " + in_quotes(entry.name) + " has a field " + in_quotes(text) +
                  "; expected dtype, shape and data_offsets");
    }
    if (!entry.fields.insert(text).second) {
      return fail("tensor " + in_quotes(entry.name) + " has its " + text + " twice");
    }
    field_ = text;
    return true;
  }

  // Reports an unexpected kind of value.
  bool unexpected() {
    switch (in_) {
      case In::outside:
        return fail("the header is not a JSON object");
      case In::header:
        return key_ == "__metadata__"
                   ? fail("__metadata__ is not an object; expected texts by name")
                   : fail("tensor " + in_quotes(key_) + " is not described by an object");
      case In::metadata:
        return fail("metadata " + in_quotes(key_) + " is not a text");
      case In::tensor:
        return fail("tensor " + in_quotes(entries.back().name) + ": " + field_ + " is not " +
                    (field_ == "dtype" ? "a text" : "a list"));
      case In::numbers:
        break;
    }
    return fail("tensor " + in_quotes(entries.back().name) + ": " + field_ +
                " holds something else than whole numbers from 0 on");
  }

  In in_ = In::outside;
  std::string key_, field_;
  std::set<std::string> names_;
  std::vector<uint64_t>* numbers_ = nullptr;  // The list being filled.
};

// The tensor that `entry` describes, if type, shape and position in `data` agree.
Result<Tensor> read_tensor(const Entry& entry, std::string_view data, const std::string& name) {
  const std::string where = name + ": tensor " + in_quotes(entry.name);
  Tensor tensor;
  if (entry.type != "F32" && entry.type != "F16" && entry.type != "I8") {
    return Error{where + " has type " + printable(entry.type) + "; expected F32, F16 or I8"};
  }
  tensor.half = entry.type == "F16";
  tensor.int8 = entry.type == "I8";
  const uint64_t width = tensor.int8 ? 1 : tensor.half ? 2 : 4;
  const uint64_t begin = entry.offsets[0], end = entry.offsets[1];
  if (begin > end || end > data.size()) {
    return Error{where + " lies at bytes " + std::to_string(begin) + " to " + std::to_string(end) +
                 " of the data; the data has " + std::to_string(data.size()) + " bytes"};
  }
  uint64_t count = 1;
  for (const uint64_t size : entry.shape) {
    if (size > static_cast<uint64_t>(std::numeric_limits<int64_t>::max()) ||
        (count != 0 && size > std::numeric_limits<uint64_t>::max() / width / count)) {
      return Error{where + " has shape " + shape_text(entry.shape) +
                   ", more numbers than any file can hold"};
    }
    count *= size;
    tensor.shape.push_back(static_cast<int64_t>(size));
  }
  if (count * width != end - begin) {
    return Error{where + " has " + std::to_string(end - begin) + " bytes; expected " +
                 std::to_string(count * width) + " for shape " + shape_text(entry.shape) + " of " +
                 entry.type};
  }
  tensor.values.resize(count);
  for (size_t i = 0; i < count; ++i) {
    const uint64_t bits = little_endian(data.substr(begin + i * width, width));
    tensor.values[i] = tensor.int8   ? static_cast<float>(static_cast<int8_t>(bits))
                       : tensor.half ? from_half(static_cast<uint16_t>(bits))
                                     : std::bit_cast<float>(static_cast<uint32_t>(bits));
  }
  return tensor;
}

// Rejects tensors that share bytes, and bytes outside all tensors.
Result<void> check_coverage(std::vector<Entry>& entries, uint64_t bytes, const std::string& name) {
  // Not as vectors: GCC 12's library compares too few of their bytes on big-endian machines.
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return std::pair(a.offsets[0], a.offsets[1]) < std::pair(b.offsets[0], b.offsets[1]);
  });
  uint64_t covered = 0;
  for (const Entry& entry : entries) {
    const uint64_t begin = entry.offsets[0];
    if (begin != covered) {
      return Error{name + ": tensor " + in_quotes(entry.name) + " starts at byte " +
                   std::to_string(begin) + " of the data; expected " + std::to_string(covered) +
                   ", where the one before it ends"};
    }
    covered = entry.offsets[1];
  }
  if (covered != bytes) {
    return Error{name + ": the data has " + std::to_string(bytes) + " bytes; its tensors have " +
                 std::to_string(covered)};
  }
  return {};
}

const char* type_of(const Tensor& tensor) {
  return tensor.int8 ? "I8" : tensor.half ? "F16" : "F32";
}

void append_values(const Tensor& tensor, std::string& out) {
  assert(std::accumulate(tensor.shape.begin(), tensor.shape.end(), int64_t{1},
                         std::multiplies<>()) == static_cast<int64_t>(tensor.values.size()));
  for (const float value : tensor.values) {
    if (tensor.int8) {
      assert(value >= -128 && value <= 127 && value == std::trunc(value));
      out += static_cast<char>(static_cast<int8_t>(value));
    } else if (tensor.half) {
      append_little_endian(to_half(value), 2, out);
    } else {
      append_little_endian(std::bit_cast<uint32_t>(value), 4, out);
    }
  }
}

std::string json_text(const std::string& text) {
  using nlohmann::json;
  return json(text).dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace

Result<const Tensor*> find_tensor(const TensorFile& file, const std::string& key,
                                  const std::vector<int64_t>& shape, const std::string& name,
                                  float limit) {
  const std::string where = name + ": tensor '" + key + "' ";
  const auto found = file.tensors.find(key);
  if (found == file.tensors.end()) return Error{where + "is missing"};
  const Tensor& tensor = found->second;
  const auto fits = [](int64_t size, int64_t expected) {
    return expected < 0 ? size > 0 && size <= std::numeric_limits<int>::max() : size == expected;
  };
  if (!std::equal(tensor.shape.begin(), tensor.shape.end(), shape.begin(), shape.end(), fits)) {
    return Error{where + "has shape " + shape_text(tensor.shape) + "; expected " +
                 shape_text(shape)};
  }
  const auto bad = std::find_if_not(tensor.values.begin(), tensor.values.end(), [&](float v) {
    return std::isfinite(v) && std::abs(v) < limit;
  });
  if (bad == tensor.values.end()) return &tensor;
  return Error{where + "holds a number that is " +
               (std::isfinite(*bad) ? "too large" : "not finite") + " (number " +
               std::to_string(bad - tensor.values.begin()) + ")"};
}

Result<TensorFile> parse_safetensors(std::string_view bytes, const std::string& name) {
  if (bytes.size() < kLengthBytes) {
    return Error{name + ": has " + std::to_string(bytes.size()) +
                 " bytes; expected a safetensors file, which starts with the 8-byte length of its "
                 "header"};
  }
  const uint64_t length = little_endian(bytes.substr(0, kLengthBytes));
  const std::string_view rest = bytes.substr(kLengthBytes);
  if (length > kMaxHeaderBytes) {
    return Error{name + ": does not start with the length of a header (at most " +
                     std::to_string(kMaxHeaderBytes) + " bytes); expected a safetensors file",
                 ErrorKind::not_safetensors};
  }
  if (length > rest.size()) {
    return Error{name + ": ends inside its header of " + std::to_string(length) +
                 " bytes; is the file complete?"};
  }
  const std::string_view header = rest.substr(0, length), data = rest.substr(length);
  if (!header.starts_with('{')) {
    return Error{name + ": has no JSON header; expected a safetensors file",
                 ErrorKind::not_safetensors};
  }
  HeaderReader reader;
  if (!nlohmann::json::sax_parse(header.begin(), header.end(), &reader)) {
    return Error{name + ": " + reader.problem};
  }
  TensorFile file;
  file.metadata = std::move(reader.metadata);
  uint64_t left = data.size();
  for (const Entry& entry : reader.entries) {
    const uint64_t begin = entry.offsets[0], end = entry.offsets[1];
    const bool fits = begin <= end && end <= data.size();
    if (fits && end - begin > left) break;  // Some share bytes; rejected below.
    Result<Tensor> tensor = read_tensor(entry, data, name);
    if (!tensor) return tensor.error();
    left -= end - begin;
    file.tensors[entry.name] = *std::move(tensor);
  }
  if (Result<void> covered = check_coverage(reader.entries, data.size(), name); !covered) {
    return covered.error();
  }
  return file;
}

std::string format_safetensors(const TensorFile& file) {
  std::string header, data;
  // Appends a member to the header's JSON object.
  const auto member = [](std::string& object, const std::string& key, const std::string& value) {
    object += object.empty() ? '{' : ',';
    object += json_text(key);
    object += ':';
    object += value;
  };
  if (!file.metadata.empty()) {
    std::string texts;
    for (const auto& [key, text] : file.metadata) member(texts, key, json_text(text));
    member(header, "__metadata__", texts + "}");
  }
  // Wide types first: the header's length is a multiple of 8, so every number is then aligned.
  for (const char* type : {"F32", "F16", "I8"}) {
    for (const auto& [key, tensor] : file.tensors) {
      if (type_of(tensor) != std::string_view(type)) continue;
      const size_t begin = data.size();
      append_values(tensor, data);
      std::string fields;
      member(fields, "dtype", json_text(type));
      member(fields, "shape", shape_text(tensor.shape));
      member(fields, "data_offsets", shape_text(std::vector{begin, data.size()}));
      member(header, key, fields + "}");
    }
  }
  header += header.empty() ? "{}" : "}";
  header.append((kLengthBytes - header.size() % kLengthBytes) % kLengthBytes, ' ');
  std::string out;
  append_little_endian(header.size(), kLengthBytes, out);
  return out + header + data;
}

uint16_t to_half(float value) {
  const uint32_t bits = std::bit_cast<uint32_t>(value);
  const uint16_t sign = static_cast<uint16_t>(bits >> 16 & 0x8000);
  const uint32_t magnitude = bits & 0x7fffffff;
  if (magnitude > 0x7f800000) {  // NaN: its payload's upper bits, or a quiet one if those are zero.
    const uint16_t payload = static_cast<uint16_t>(magnitude >> 13 & 0x3ff);
    return sign | 0x7c00 | (payload ? payload : 0x200);
  }
  if (magnitude == 0x7f800000) return sign | 0x7c00;
  const int exponent = static_cast<int>(magnitude >> 23) - 127 + 15;  // In half's own bias.
  // The bits that half lacks: 13, and one more for each power of two below its smallest.
  const int dropped = exponent > 0 ? 13 : 14 - exponent;
  if (dropped > 24) return sign;  // Less than half of the smallest step.
  const uint32_t mantissa =
      exponent > 0 ? magnitude - ((127 - 15) << 23) : (magnitude & 0x7fffff) | 0x800000;
  const uint32_t kept = mantissa >> dropped, lost = mantissa & ((1u << dropped) - 1);
  const uint32_t halfway = 1u << (dropped - 1);
  const uint32_t rounded = kept + (lost > halfway || (lost == halfway && (kept & 1)) ? 1 : 0);
  return sign | static_cast<uint16_t>(std::min(rounded, 0x7bffu));
}

float from_half(uint16_t bits) {
  const uint32_t sign = static_cast<uint32_t>(bits & 0x8000) << 16;
  const uint32_t exponent = bits >> 10 & 0x1f;
  uint32_t mantissa = bits & 0x3ff;
  if (exponent == 0x1f) return std::bit_cast<float>(sign | 0x7f800000 | mantissa << 13);
  if (exponent > 0) {
    return std::bit_cast<float>(sign | (exponent + 127 - 15) << 23 | mantissa << 13);
  }
  // Subnormal: a whole number of 2^-24, which float holds exactly.
  const float value = static_cast<float>(mantissa) * 0x1p-24f;
  return sign ? -value : value;
}

}  // namespace panache

#include "base/inflate.h"

#include <array>
#include <cstdint>
#include <span>

namespace panache {
namespace {

constexpr int kMaxBits = 15;  // Of a code.
constexpr size_t kLiterals = 288, kDistances = 30, kCodeLengths = 19;

// Reads bits, the lowest first. Behind the end they are 0, and is_over() says so.
class Bits {
 public:
  explicit Bits(std::string_view bytes) : bytes_(bytes) {}

  uint32_t take(int count) {
    uint32_t out = 0;
    for (int i = 0; i < count; ++i) out |= static_cast<uint32_t>(bit()) << i;
    return out;
  }
  int bit() {
    if (left_ == 0) {
      over_ = over_ || at_ == bytes_.size();
      byte_ = over_ ? 0 : static_cast<unsigned char>(bytes_[at_++]);
      left_ = 8;
    }
    const int out = byte_ & 1;
    byte_ >>= 1;
    --left_;
    return out;
  }
  // The bytes from the next whole one on.
  std::string_view rest() {
    left_ = 0;
    return bytes_.substr(at_);
  }
  void skip(size_t bytes) { at_ += bytes; }
  bool is_over() const { return over_; }

 private:
  std::string_view bytes_;
  size_t at_ = 0;
  unsigned byte_ = 0;
  int left_ = 0;
  bool over_ = false;
};

// A canonical Huffman code: codes of one length are consecutive, and symbols stand in their order.
class Code {
 public:
  // `lengths`: bits of each symbol's code, 0 for none. False if there are more codes than fit.
  bool set(std::span<const uint8_t> lengths) {
    counts_ = {};
    for (const uint8_t length : lengths) ++counts_[length];
    counts_[0] = 0;
    int left = 1;
    for (int bits = 1; bits <= kMaxBits; ++bits) {
      left = 2 * left - counts_[bits];
      if (left < 0) return false;
    }
    std::array<uint16_t, kMaxBits + 2> next = {};
    for (int bits = 1; bits <= kMaxBits; ++bits) next[bits + 1] = next[bits] + counts_[bits];
    for (size_t i = 0; i < lengths.size(); ++i) {
      if (lengths[i] > 0) symbols_[next[lengths[i]]++] = static_cast<uint16_t>(i);
    }
    return true;
  }
  // The next symbol, or -1 for bits that are no code.
  int read(Bits& bits) const {
    int code = 0, first = 0, index = 0;
    for (int length = 1; length <= kMaxBits; ++length) {
      code |= bits.bit();
      const int count = counts_[length];
      if (code - first < count) return symbols_[static_cast<size_t>(index + code - first)];
      index += count;
      first = (first + count) << 1;
      code <<= 1;
    }
    return -1;
  }

 private:
  std::array<uint16_t, kMaxBits + 1> counts_ = {};
  std::array<uint16_t, kLiterals> symbols_ = {};
};

class Inflater {
 public:
  Inflater(std::string_view bytes, size_t size) : bits_(bytes), size_(size) { out_.reserve(size); }

  // False if the blocks are malformed.
  bool read_blocks() {
    for (bool is_last = false; !is_last;) {
      is_last = bits_.bit() != 0;
      const uint32_t kind = bits_.take(2);
      if (kind == 3 || bits_.is_over()) return false;
      if (!(kind == 0 ? copy_stored() : read_codes(kind == 1) && read_symbols())) return false;
    }
    return out_.size() == size_;
  }
  std::string&& take_output() { return std::move(out_); }
  std::string_view rest() { return bits_.rest(); }

 private:
  static uint32_t number(std::string_view bytes) {
    return static_cast<unsigned char>(bytes[0]) | static_cast<unsigned char>(bytes[1]) << 8;
  }

  bool copy_stored() {
    const std::string_view rest = bits_.rest();
    if (rest.size() < 4) return false;
    const uint32_t size = number(rest), check = number(rest.substr(2));
    if ((size ^ 0xffff) != check || size > rest.size() - 4 || size > size_ - out_.size()) {
      return false;
    }
    out_ += rest.substr(4, size);
    bits_.skip(4 + size);
    return true;
  }

  bool read_codes(bool are_fixed) {
    std::array<uint8_t, kLiterals + kDistances + 2> lengths = {};
    if (are_fixed) {
      for (size_t i = 0; i < kLiterals; ++i)
        lengths[i] = i < 144 ? 8 : i < 256 ? 9 : i < 280 ? 7 : 8;
      std::array<uint8_t, kDistances> distances;
      distances.fill(5);
      return literals_.set(std::span(lengths).first(kLiterals)) && distances_.set(distances);
    }
    const size_t literals = bits_.take(5) + 257, distances = bits_.take(5) + 1;
    const size_t count = bits_.take(4) + 4;
    if (literals > kLiterals || distances > kDistances) return false;
    return read_lengths(count, std::span(lengths).first(literals + distances)) &&
           literals_.set(std::span(lengths).first(literals)) &&
           distances_.set(std::span(lengths).subspan(literals, distances));
  }

  // The lengths of the codes are themselves coded.
  bool read_lengths(size_t count, std::span<uint8_t> lengths) {
    static constexpr uint8_t kOrder[kCodeLengths] = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                     11, 4,  12, 3, 13, 2, 14, 1, 15};
    std::array<uint8_t, kCodeLengths> own = {};
    for (size_t i = 0; i < count; ++i) own[kOrder[i]] = static_cast<uint8_t>(bits_.take(3));
    Code code;
    if (!code.set(own)) return false;
    for (size_t i = 0; i < lengths.size();) {
      const int symbol = code.read(bits_);
      if (symbol < 0 || bits_.is_over() || (symbol == 16 && i == 0)) return false;
      if (symbol < 16) {
        lengths[i++] = static_cast<uint8_t>(symbol);
        continue;
      }
      const uint8_t value = symbol == 16 ? lengths[i - 1] : 0;
      size_t times = symbol == 16   ? 3 + bits_.take(2)
                     : symbol == 17 ? 3 + bits_.take(3)
                                    : 11 + bits_.take(7);
      if (times > lengths.size() - i) return false;
      while (times-- > 0) lengths[i++] = value;
    }
    return true;
  }

  bool read_symbols() {
    static constexpr uint16_t kLength[] = {3,  4,  5,  6,   7,   8,   9,   10,  11, 13,
                                           15, 17, 19, 23,  27,  31,  35,  43,  51, 59,
                                           67, 83, 99, 115, 131, 163, 195, 227, 258};
    static constexpr uint16_t kDistance[] = {
        1,   2,   3,   4,   5,   7,    9,    13,   17,   25,   33,   49,   65,    97,    129,
        193, 257, 385, 513, 769, 1025, 1537, 2049, 3073, 4097, 6145, 8193, 12289, 16385, 24577};
    while (true) {
      const int symbol = literals_.read(bits_);
      if (symbol < 0 || bits_.is_over()) return false;
      if (symbol == 256) return true;
      if (symbol < 256) {
        if (out_.size() == size_) return false;
        out_ += static_cast<char>(symbol);
        continue;
      }
      const size_t which = static_cast<size_t>(symbol - 257);
      if (which >= std::size(kLength)) return false;
      const int extra = which < 8 || which == 28 ? 0 : static_cast<int>(which / 4) - 1;
      const size_t length = kLength[which] + bits_.take(extra);
      const int far = distances_.read(bits_);
      if (far < 0 || far >= static_cast<int>(kDistances)) return false;
      const size_t distance =
          kDistance[static_cast<size_t>(far)] + bits_.take(far < 4 ? 0 : far / 2 - 1);
      if (distance > out_.size() || length > size_ - out_.size()) return false;
      for (size_t i = 0; i < length; ++i) out_ += out_[out_.size() - distance];
    }
  }

  Bits bits_;
  size_t size_;
  std::string out_;
  Code literals_, distances_;
};

uint32_t adler32(std::string_view bytes) {
  uint32_t a = 1, b = 0;
  for (const char c : bytes) {
    a = (a + static_cast<unsigned char>(c)) % 65521;
    b = (b + a) % 65521;
  }
  return b << 16 | a;
}

}  // namespace

std::optional<std::string> inflate(std::string_view stream, size_t size) {
  constexpr size_t kHeader = 2, kChecksum = 4;
  if (stream.size() < kHeader + kChecksum || size > kMaxInflation * stream.size()) return {};
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(stream[i]); };
  const bool is_deflate = (byte(0) & 15) == 8, has_dictionary = (byte(1) & 32) != 0;
  if (!is_deflate || has_dictionary || (byte(0) * 256 + byte(1)) % 31 != 0) return {};
  Inflater inflater(stream.substr(kHeader), size);
  if (!inflater.read_blocks()) return {};
  const std::string_view rest = inflater.rest();
  if (rest.size() < kChecksum) return {};
  uint32_t checksum = 0;
  for (size_t i = 0; i < kChecksum; ++i) {
    checksum = checksum << 8 | static_cast<unsigned char>(rest[i]);
  }
  std::string out = inflater.take_output();
  if (adler32(out) != checksum) return {};
  return out;
}

}  // namespace panache

// zlib streams of other programs are unpacked, and damaged ones are rejected.

#include "base/inflate.h"

#include <cstring>
#include <string>

#include <gtest/gtest.h>

namespace panache {
namespace {

// The times of 40 keys at 30 a second, as eight bytes each, packed by zlib with codes of its own.
const std::string kTimes(
    "\x78\xda\x63\x60\x80\x80\x15\x75\x87\xa3\x41\x74\xc0\xdf\xb6\xed\x20\xfa\x47\xb5\x97"
    "\x30\x23\x90\x5e\xf0\x8b\x37\x1f\x44\x7b\x54\x5e\x3c\x05\xa2\x3f\x7c\x9f\xa2\xc6\x04"
    "\xa4\x67\x94\x45\x34\x81\x68\x87\xaf\xd2\xf7\x40\xf4\x8b\xe2\xfb\x96\xcc\x40\x7a\xc2"
    "\xa7\x45\x53\x41\xb4\x45\x61\xda\x47\x10\xfd\xe0\xbd\xa6\x2f\x0b\x90\xee\xc8\x7b\xbb"
    "\x02\x44\x1b\xbc\xdd\xc0\xc2\x0a\xa4\x6f\x64\x97\x24\x80\xe8\x86\x57\xe6\x7b\x40\xb4"
    "\x46\xe6\x6f\x71\x36\x20\x7d\xe1\xf9\xbe\x62\x10\x5d\x91\xd6\x74\x1e\x44\x2b\x3c\x75"
    "\xd5\x66\x07\xd2\x27\x92\x39\xdb\x41\x74\xc1\xa3\x33\x8f\x40\xb4\x44\xe2\x04\x3b\x0e"
    "\x20\x7d\xe0\x7e\xf0\x2c\x10\x9d\x11\x27\xfe\x0d\x44\x0b\xdc\xbd\x15\xc8\x09\xa4\x77"
    "\x44\xcf\x5b\x0b\xa2\x13\x6e\x25\x72\x72\x01\x69\x8e\x48\xd5\x54\x10\xbd\xe1\xfa\x8b"
    "\x03\x20\x3a\x22\x6c\x8d\x0c\x37\xc8\xa3\x57\xf3\x2b\x40\xf4\x8a\x60\xe3\x2b\x20\x3a"
    "\xe0\xd2\x37\x7d\x1e\x90\xff\x03\x76\x75\x83\xe8\x05\xe7\x6b\x9f\x83\x68\x0f\x3f\x47"
    "\x67\x5e\x90\xff\xcf\xb0\xcc\x07\xd1\x33\xbc\x4f\xfc\x02\xd1\x00\x12\x41\x54\xca",
    251);
// "abcabcabcabcabd" three times, packed by zlib with the codes of the format.
const std::string kLetters("\x78\x01\x4b\x4c\x4a\x4e\x44\xa0\x94\x44\xbc\x5c\x00\x8c\x84\x11\x3e",
                           17);

std::string times() {
  std::string out;
  for (int64_t i = 0; i < 40; ++i) {
    const int64_t time = i * 1'539'538'600;
    out.append(reinterpret_cast<const char*>(&time), sizeof time);
  }
  return out;
}

std::string letters() {
  std::string out;
  for (int i = 0; i < 3; ++i) out += "abcabcabcabcabd";
  return out;
}

TEST(Inflate, unpacks_codes_of_both_kinds_and_stored_bytes) {
  EXPECT_EQ(inflate(kTimes, 320), times());
  EXPECT_EQ(inflate(kLetters, 45), letters());
  const std::string stored(
      "\x78\x01\x01\x03\x00\xfc\xff"
      "abc\x02\x4d\x01\x27",
      14);
  EXPECT_EQ(inflate(stored, 3), "abc");
}

TEST(Inflate, rejects_another_size_and_every_cut) {
  for (const std::string& stream : {kTimes, kLetters}) {
    const size_t size = stream == kTimes ? 320 : 45;
    EXPECT_FALSE(inflate(stream, size - 1));
    EXPECT_FALSE(inflate(stream, size + 1));
    EXPECT_FALSE(inflate(stream, size_t{1} << 40));
    for (size_t cut = 0; cut < stream.size(); ++cut) {
      EXPECT_FALSE(inflate(stream.substr(0, cut), size)) << cut;
    }
  }
}

TEST(Inflate, rejects_every_flipped_bit_but_those_of_the_level) {
  for (const std::string& stream : {kTimes, kLetters}) {
    for (size_t bit = 0; bit < 8 * stream.size(); ++bit) {
      std::string flipped = stream;
      flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ 1 << bit % 8);
      const auto out = inflate(flipped, stream == kTimes ? 320 : 45);
      // Bits behind the last code have no meaning.
      EXPECT_TRUE(!out || *out == (stream == kTimes ? times() : letters())) << bit;
    }
  }
}

}  // namespace
}  // namespace panache

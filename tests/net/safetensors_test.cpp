#include "net/safetensors.h"

#include <bit>
#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace panache {
namespace {

const char* const kName = "model.safetensors";

// A file with this header and this many zero bytes of data.
std::string raw(const std::string& header, size_t data_bytes) {
  std::string bytes;
  for (int i = 0; i < 8; ++i) bytes += static_cast<char>(header.size() >> (8 * i) & 0xff);
  return bytes + header + std::string(data_bytes, '\0');
}

std::string failure(const std::string& bytes) {
  const Result<TensorFile> file = parse_safetensors(bytes, kName);
  return file.ok() ? "" : file.error().message;
}
std::string failure(const std::string& header, size_t data_bytes) {
  return failure(raw(header, data_bytes));
}

TensorFile small_file() {
  TensorFile file;
  file.metadata = {{"format", "panache"}, {"styles", "old\n\"proud\" \\ \xc3\xa9"}};
  file.tensors["a.bias"] = {{3}, {0.5f, -2, 65504}, true};
  file.tensors["b.weight"] = {{2, 2}, {1, -0.0f, 3.25f, 1e-30f}, false};
  file.tensors["empty"] = {{0, 4}, {}, false};
  file.tensors["scalar"] = {{}, {7}, false};
  file.tensors["whole"] = {{3}, {-128, 127, 0}, false, true};
  return file;
}

void expect_equal(const TensorFile& a, const TensorFile& b) {
  EXPECT_EQ(a.metadata, b.metadata);
  ASSERT_EQ(a.tensors.size(), b.tensors.size());
  for (const auto& [key, tensor] : a.tensors) {
    ASSERT_TRUE(b.tensors.contains(key)) << key;
    const Tensor& other = b.tensors.at(key);
    EXPECT_EQ(tensor.shape, other.shape) << key;
    EXPECT_EQ(tensor.values, other.values) << key;
    EXPECT_EQ(tensor.half, other.half) << key;
    EXPECT_EQ(tensor.int8, other.int8) << key;
  }
}

TEST(Safetensors, what_is_written_reads_back) {
  const TensorFile file = small_file();
  const Result<TensorFile> back = parse_safetensors(format_safetensors(file), kName);
  ASSERT_TRUE(back.ok()) << back.error().message;
  expect_equal(file, *back);
  const Result<TensorFile> nothing = parse_safetensors(format_safetensors({}), kName);
  ASSERT_TRUE(nothing.ok()) << nothing.error().message;
  expect_equal({}, *nothing);
}

TEST(Safetensors, the_bytes_are_those_of_the_format) {
  TensorFile file;
  file.metadata = {{"k", "v"}};
  file.tensors["h"] = {{1}, {1}, true};
  file.tensors["b"] = {{2}, {-1, 100}, false, true};
  file.tensors["z"] = {{1, 2}, {1, -2}, false};
  const std::string header =
      R"({"__metadata__":{"k":"v"},"z":{"dtype":"F32","shape":[1, 2],"data_offsets":[0, 8]},)"
      R"("h":{"dtype":"F16","shape":[1],"data_offsets":[8, 10]},)"
      R"("b":{"dtype":"I8","shape":[2],"data_offsets":[10, 12]}})";
  const std::string bytes = format_safetensors(file);
  const size_t padded = (header.size() + 7) / 8 * 8;
  EXPECT_EQ(static_cast<unsigned char>(bytes[0]), padded);
  EXPECT_EQ(bytes.substr(1, 7), std::string(7, '\0'));
  EXPECT_EQ(bytes.substr(8, padded), header + std::string(padded - header.size(), ' '));
  EXPECT_EQ(bytes.substr(8 + padded),
            std::string("\x00\x00\x80\x3f\x00\x00\x00\xc0\x00\x3c\xff\x64", 12));
}

TEST(Safetensors, text_that_is_not_utf8_is_written_as_a_file_that_reads) {
  TensorFile file;
  file.metadata = {{"licence", "\xff"}};
  const Result<TensorFile> back = parse_safetensors(format_safetensors(file), kName);
  ASSERT_TRUE(back.ok()) << back.error().message;
  EXPECT_EQ(back->metadata.at("licence"), "\xef\xbf\xbd");
}

TEST(Safetensors, every_truncation_is_rejected) {
  const std::string bytes = format_safetensors(small_file());
  for (size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_TRUE(failure(bytes.substr(0, size)).starts_with("model.safetensors: ")) << size;
  }
  EXPECT_NE(failure(bytes + '\0'), "");
}

TEST(Safetensors, every_changed_byte_is_rejected_or_gives_a_whole_file) {
  const std::string bytes = format_safetensors(small_file());
  for (size_t i = 0; i < bytes.size(); ++i) {
    for (int value = 0; value < 256; ++value) {
      std::string changed = bytes;
      changed[i] = static_cast<char>(value);
      const Result<TensorFile> file = parse_safetensors(changed, kName);
      if (!file.ok()) {
        EXPECT_TRUE(file.error().message.starts_with("model.safetensors: "));
        EXPECT_EQ(file.error().message.find('\n'), std::string::npos);
        continue;
      }
      for (const auto& [key, tensor] : file->tensors) {
        size_t count = 1;
        for (const int64_t size : tensor.shape) count *= size;
        ASSERT_EQ(count, tensor.values.size()) << "byte " << i << " = " << value << ", " << key;
      }
    }
  }
}

TEST(Safetensors, what_is_no_safetensors_file_is_rejected) {
  EXPECT_EQ(failure("HIERAR"),
            "model.safetensors: has 6 bytes; expected a safetensors file, which starts with the "
            "8-byte length of its header");
  EXPECT_EQ(failure("HIERARCHY\nROOT Hips"),
            "model.safetensors: does not start with the length of a header (at most 4194304 "
            "bytes); expected a safetensors file");
  EXPECT_EQ(failure(raw("{}", 0).substr(0, 9)),
            "model.safetensors: ends inside its header of 2 bytes; is the file complete?");
  EXPECT_EQ(failure("[1]", 0),
            "model.safetensors: has no JSON header; expected a safetensors file");
  EXPECT_EQ(failure(R"({"a":})", 0),
            "model.safetensors: the header is not JSON from its byte 6 on");
  EXPECT_EQ(failure("{} {}", 0), "model.safetensors: the header is not JSON from its byte 4 on");
}

TEST(Safetensors, a_type_other_than_f32_f16_and_i8_is_rejected_with_its_name) {
  EXPECT_EQ(failure(R"({"pose.0.weight":{"dtype":"I64","shape":[1],"data_offsets":[0,8]}})", 8),
            "model.safetensors: tensor 'pose.0.weight' has type I64; expected F32, F16 or I8");
  EXPECT_EQ(failure(R"({"a":{"dtype":"BF16","shape":[1],"data_offsets":[0,2]}})", 2),
            "model.safetensors: tensor 'a' has type BF16; expected F32, F16 or I8");
}

TEST(Safetensors, offsets_that_do_not_fit_are_rejected) {
  const auto at = [](const std::string& offsets) {
    return R"({"a":{"dtype":"F32","shape":[2],"data_offsets":)" + offsets + "}}";
  };
  EXPECT_EQ(failure(at("[0,8]"), 8), "");
  EXPECT_EQ(failure(at("[0,8]"), 4),
            "model.safetensors: tensor 'a' lies at bytes 0 to 8 of the data; the data has 4 bytes");
  EXPECT_EQ(failure(at("[8,0]"), 8),
            "model.safetensors: tensor 'a' lies at bytes 8 to 0 of the data; the data has 8 bytes");
  EXPECT_EQ(failure(at("[0,18446744073709551615]"), 8),
            "model.safetensors: tensor 'a' lies at bytes 0 to 18446744073709551615 of the data; "
            "the data has 8 bytes");
  EXPECT_EQ(failure(at("[0,4]"), 8),
            "model.safetensors: tensor 'a' has 4 bytes; expected 8 for shape [2] of F32");
  EXPECT_EQ(failure(at("[0,12]"), 12),
            "model.safetensors: tensor 'a' has 12 bytes; expected 8 for shape [2] of F32");
  EXPECT_EQ(failure(at("[0,8]"), 12),
            "model.safetensors: the data has 12 bytes; its tensors have 8");
  EXPECT_EQ(failure(at("[4,12]"), 12),
            "model.safetensors: tensor 'a' starts at byte 4 of the data; expected 0, where the one "
            "before it ends");
  EXPECT_EQ(failure(at("[0]"), 8),
            "model.safetensors: tensor 'a': data_offsets has 1 numbers; expected 2");
}

TEST(Safetensors, a_byte_is_a_number_of_its_own) {
  const auto at = [](const std::string& offsets) {
    return R"({"a":{"dtype":"I8","shape":[3],"data_offsets":)" + offsets + "}}";
  };
  EXPECT_EQ(failure(at("[0,3]"), 3), "");
  EXPECT_EQ(failure(at("[0,12]"), 12),
            "model.safetensors: tensor 'a' has 12 bytes; expected 3 for shape [3] of I8");
  EXPECT_EQ(failure(at("[0,3]"), 2),
            "model.safetensors: tensor 'a' lies at bytes 0 to 3 of the data; the data has 2 bytes");
}

TEST(Safetensors, overlaps_and_holes_are_rejected) {
  const auto two = [](const std::string& second) {
    return R"({"a":{"dtype":"F32","shape":[2],"data_offsets":[0,8]},)"
           R"("b":{"dtype":"F32","shape":[2],"data_offsets":)" +
           second + "}}";
  };
  EXPECT_EQ(failure(two("[8,16]"), 16), "");
  EXPECT_EQ(failure(two("[4,12]"), 12),
            "model.safetensors: tensor 'b' starts at byte 4 of the data; expected 8, where the one "
            "before it ends");
  EXPECT_EQ(failure(two("[12,20]"), 20),
            "model.safetensors: tensor 'b' starts at byte 12 of the data; expected 8, where the "
            "one before it ends");
}

TEST(Safetensors, shapes_beyond_all_bounds_are_rejected) {
  const auto of = [](const std::string& shape) {
    return R"({"a":{"dtype":"F32","shape":)" + shape + R"(,"data_offsets":[0,0]}})";
  };
  EXPECT_EQ(failure(of("[0,7]"), 0), "");
  for (const char* shape : {"[4294967296, 4294967296]", "[9223372036854775808]",
                            "[2, 9223372036854775807]", "[4611686018427387904]"}) {
    EXPECT_EQ(failure(of(shape), 0), std::string("model.safetensors: tensor 'a' has shape ") +
                                         shape + ", more numbers than any file can hold");
  }
  EXPECT_EQ(failure(of("[1,1,1,1,1,1,1,1,1]"), 0),
            "model.safetensors: tensor 'a': shape has more than 8 numbers");
}

TEST(Safetensors, values_of_the_wrong_kind_are_rejected) {
  const auto a = [](const std::string& fields) { return failure("{\"a\":{" + fields + "}}", 4); };
  const std::string start = "model.safetensors: tensor 'a'";
  EXPECT_EQ(a(R"("dtype":32,"shape":[1],"data_offsets":[0,4])"), start + ": dtype is not a text");
  EXPECT_EQ(a(R"("dtype":["F32"],"shape":[1],"data_offsets":[0,4])"),
            start + ": dtype is not a text");
  EXPECT_EQ(a(R"("dtype":"F32","shape":1,"data_offsets":[0,4])"), start + ": shape is not a list");
  const std::string whole = " holds something else than whole numbers from 0 on";
  for (const char* bad : {"-1", "1.0", "\"1\"", "null", "true", "[1]", "{}"}) {
    EXPECT_EQ(a(R"("dtype":"F32","shape":[)" + std::string(bad) + R"(],"data_offsets":[0,4])"),
              start + ": shape" + whole)
        << bad;
  }
  EXPECT_EQ(a(R"("dtype":"F32","shape":[1])"),
            start + " is described in part; expected dtype, shape and data_offsets");
  EXPECT_EQ(a(R"("dtype":"F32","dtype":"F16","shape":[1],"data_offsets":[0,4])"),
            start + " has its dtype twice");
  EXPECT_EQ(a(R"("dtype":"F32","strides":[1])"),
            start + " has a field 'strides'; expected dtype, shape and data_offsets");
  EXPECT_EQ(failure(R"({"a":[]})", 0), start + " is not described by an object");
}

TEST(Safetensors, names_that_come_twice_are_rejected) {
  const std::string a = R"("a":{"dtype":"F32","shape":[0],"data_offsets":[0,0]})";
  EXPECT_EQ(failure("{" + a + "," + a + "}", 0),
            "model.safetensors: the header has tensor 'a' twice");
  EXPECT_EQ(failure(R"({"__metadata__":{"k":"1","k":"2"}})", 0),
            "model.safetensors: the header has metadata 'k' twice");
}

TEST(Safetensors, metadata_that_is_not_text_is_rejected) {
  for (const char* bad : {"1", "null", "true", "-1", "0.5", "[]", "{}"}) {
    EXPECT_EQ(failure(R"({"__metadata__":{"k":)" + std::string(bad) + "}}", 0),
              "model.safetensors: metadata 'k' is not a text");
  }
  EXPECT_EQ(failure(R"({"__metadata__":"k"})", 0),
            "model.safetensors: __metadata__ is not an object; expected texts by name");
}

TEST(Safetensors, deep_nesting_is_rejected_without_descending) {
  std::string deep = "{\"a\":";
  deep.append(3'000'000, '[');
  EXPECT_EQ(failure(deep, 0), "model.safetensors: tensor 'a' is not described by an object");
}

TEST(Safetensors, hostile_names_are_made_fit_for_a_message) {
  const std::string name = "x\\n\\u0007" + std::string(200, 'y');
  EXPECT_EQ(failure("{\"" + name + "\":1}", 0), "model.safetensors: tensor 'x??" +
                                                    std::string(77, 'y') +
                                                    "...' is not described by an object");
}

TEST(Half, all_65536_patterns_come_back) {
  for (uint32_t bits = 0; bits < 0x10000; ++bits) {
    const uint16_t half = static_cast<uint16_t>(bits);
    ASSERT_EQ(to_half(from_half(half)), half) << bits;
  }
}

TEST(Half, patterns_mean_what_the_standard_says) {
  EXPECT_EQ(from_half(0x3c00), 1.0f);
  EXPECT_EQ(from_half(0xc000), -2.0f);
  EXPECT_EQ(from_half(0x7bff), 65504.0f);
  EXPECT_EQ(from_half(0x0400), 0x1p-14f);
  EXPECT_EQ(from_half(0x0001), 0x1p-24f);
  EXPECT_EQ(from_half(0x3555), 0.333251953125f);
  EXPECT_TRUE(std::isinf(from_half(0x7c00)));
  EXPECT_TRUE(std::isnan(from_half(0x7e00)));
  EXPECT_TRUE(std::signbit(from_half(0x8000)));
}

TEST(Half, every_number_between_two_halves_goes_to_the_nearest_and_a_tie_to_the_even_one) {
  for (uint16_t low = 0; low < 0x7bff; ++low) {
    const uint16_t high = low + 1;
    // A half has 13 bits less than a float: the middle of two is exact.
    const float middle = from_half(low) + (from_half(high) - from_half(low)) / 2;
    const uint16_t even = low % 2 == 0 ? low : high;
    ASSERT_EQ(to_half(middle), even) << low;
    ASSERT_EQ(to_half(-middle), even | 0x8000) << low;
    ASSERT_EQ(to_half(std::nextafter(middle, 0.0f)), low) << low;
    ASSERT_EQ(to_half(std::nextafter(middle, 1e9f)), high) << low;
  }
}

TEST(Half, finite_numbers_stay_finite) {
  EXPECT_EQ(to_half(65519.0f), 0x7bff);
  EXPECT_EQ(to_half(65520.0f), 0x7bff);
  EXPECT_EQ(to_half(-1e30f), 0xfbff);
  EXPECT_EQ(to_half(std::numeric_limits<float>::infinity()), 0x7c00);
  EXPECT_EQ(to_half(1e-30f), 0);
  EXPECT_EQ(to_half(-std::numeric_limits<float>::denorm_min()), 0x8000);
  // A NaN whose payload does not fit stays one.
  EXPECT_TRUE(std::isnan(from_half(to_half(std::bit_cast<float>(0x7f800001u)))));
}

}  // namespace
}  // namespace panache

// Data inside of addresses.

#include "clip/gltf_json.h"

#include <gtest/gtest.h>

namespace panache {
namespace {

TEST(GltfUri, data_may_be_base64_or_percent_encoded) {
  EXPECT_EQ(*decode_data_uri("data:;base64,AAEC/w=="), std::string("\0\1\2\xff", 4));
  EXPECT_EQ(*decode_data_uri("data:text/plain,a%4Ab%4ac%20"), "aJbJc ");
  EXPECT_EQ(*decode_data_uri("data:,%0a%Af%9A%fF"), "\x0a\xaf\x9a\xff");
  // What is no code stays as it is.
  EXPECT_EQ(*decode_data_uri("data:,%zz%4"), "%zz%4");
  EXPECT_EQ(*decode_data_uri("data:,%4g%g4%"), "%4g%g4%");
  EXPECT_EQ(*decode_data_uri("data:,%/1%:1%@1%G1%`1"), "%/1%:1%@1%G1%`1");
  const auto no_comma = decode_data_uri("data:text/plain");
  ASSERT_FALSE(no_comma.ok());
  EXPECT_EQ(no_comma.error().message,
            "expected a data URI with a comma before its data, found none");
}

TEST(GltfUri, what_is_made_reads_back) {
  std::string bytes;
  for (int i = 0; i < 8; ++i) {
    EXPECT_EQ(*decode_data_uri(make_data_uri("image/png", bytes)), bytes);
    bytes += static_cast<char>(37 * i + 250);
  }
}

}  // namespace
}  // namespace panache

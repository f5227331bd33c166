// Styles taken out of a model, removed and added, as bytes.
#include "stick_api.h"

namespace {

using StylesApi = panache::test::StickApi;
using panache::test::model_bytes;

std::string taken(panache_bytes* bytes) {
  if (!bytes) return "";
  const std::string out(static_cast<const char*>(panache_bytes_data(bytes)),
                        panache_bytes_size(bytes));
  panache_bytes_destroy(bytes);
  return out;
}
std::string extract(const std::string& model, const char* name) {
  panache_bytes* out = nullptr;
  EXPECT_EQ(panache_styles_extract(model.data(), model.size(), name, &out), PANACHE_OK)
      << panache_last_error();
  return taken(out);
}
std::string remove(const std::string& model, const char* name) {
  panache_bytes* out = nullptr;
  EXPECT_EQ(panache_styles_remove(model.data(), model.size(), name, &out), PANACHE_OK)
      << panache_last_error();
  return taken(out);
}
panache_status add(const std::string& model, const std::string& style, int replace,
                   panache_bytes** out) {
  return panache_styles_add(model.data(), model.size(), style.data(), style.size(), replace, out);
}

TEST_F(StylesApi, styles_have_the_groups_of_the_model) {
  const int count = panache_model_style_count(model_);
  std::string groups;
  for (int i = 0; i < count; ++i) groups += "group " + std::to_string(i / 2) + "\\n";
  const std::string bytes = panache::test::with_list(model_bytes(), "style_groups", groups);
  panache_model* model = nullptr;
  ASSERT_EQ(panache_model_create(bytes.data(), bytes.size(), &model), PANACHE_OK)
      << panache_last_error();
  for (int i = 0; i < count; ++i) {
    EXPECT_EQ(panache_model_style_group(model, i), "group " + std::to_string(i / 2));
  }
  EXPECT_EQ(panache_model_style_group(model, count), nullptr);
  panache_model_destroy(model);
}

TEST_F(StylesApi, a_style_is_extracted_removed_and_added_again) {
  const std::string whole = model_bytes();
  const std::string last = panache_model_style_name(model_, panache_model_style_count(model_) - 1);
  const std::string style = extract(whole, last.c_str());
  const std::string without = remove(whole, last.c_str());
  panache_model* model = nullptr;
  ASSERT_EQ(panache_model_create(without.data(), without.size(), &model), PANACHE_OK);
  EXPECT_EQ(panache_model_find_style(model, last.c_str()), -1);
  EXPECT_EQ(panache_model_style_count(model), panache_model_style_count(model_) - 1);
  panache_model_destroy(model);

  panache_bytes* again = nullptr;
  ASSERT_EQ(add(without, style, 0, &again), PANACHE_OK) << panache_last_error();
  EXPECT_EQ(taken(again), whole);
  ASSERT_EQ(add(whole, style, 1, &again), PANACHE_OK) << panache_last_error();
  EXPECT_EQ(taken(again), whole);
  panache_bytes_destroy(nullptr);
}

TEST_F(StylesApi, what_is_wrong_is_said_and_no_bytes_are_made) {
  const std::string whole = model_bytes(), style = extract(whole, "old");
  panache_bytes* none = nullptr;
  EXPECT_EQ(add(whole, style, 0, &none), PANACHE_BAD_ARGUMENT);
  EXPECT_STREQ(panache_last_error(),
               "the model has a style 'old' already; give another name, or replace it");
  EXPECT_EQ(add(whole, whole, 1, &none), PANACHE_BAD_STYLE);
  EXPECT_EQ(add(whole, style.substr(0, 100), 1, &none), PANACHE_BAD_STYLE);
  EXPECT_EQ(add(style, style, 1, &none), PANACHE_BAD_MODEL);
  EXPECT_EQ(panache_styles_remove(whole.data(), whole.size(), "nobody", &none),
            PANACHE_BAD_ARGUMENT);
  EXPECT_TRUE(std::string(panache_last_error()).find("nobody") != std::string::npos);
  EXPECT_EQ(panache_styles_extract(whole.data(), whole.size(), "nobody", &none),
            PANACHE_BAD_ARGUMENT);
  EXPECT_EQ(panache_styles_extract("x", 1, "old", &none), PANACHE_BAD_MODEL);
  EXPECT_EQ(none, nullptr);
}

}  // namespace

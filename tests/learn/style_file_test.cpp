// Styles as files of their own: what comes along, what stays behind, and what is rejected.

#include "learn/style_file.h"

#include <algorithm>
#include <bit>
#include <functional>

#include <gtest/gtest.h>

#include "make_model.h"
#include "make_walks.h"
#include "net/layer.h"
#include "style/networks/networks.h"
#include "style/style_checks.h"

namespace panache {
namespace {

std::vector<std::string> styles_of(const TensorFile& file) {
  std::vector<std::string> names;
  const auto model = read(file);
  for (const StyleInfo& style : model->styles()) names.push_back(style.name);
  return names;
}

using Names = std::vector<std::string>;

// A model of two built-in and two learnt styles.
TensorFile mixed_model(uint64_t seed = 1) {
  TensorFile file = test::make_model({"old", "proud"}, seed);
  test::add_learnt(file, 0, "limping", "limp.bvh", 7);
  test::add_learnt(file, 1, "sneaking", "", 8);
  return file;
}

TensorFile extract(const TensorFile& model, const std::string& style) {
  const auto file = extract_style(model, style, "m.safetensors");
  EXPECT_TRUE(file.ok()) << file.error().message;
  return *file;
}
TensorFile removed(const TensorFile& model, const std::string& style) {
  const auto file = remove_style(model, style, "m.safetensors");
  EXPECT_TRUE(file.ok()) << file.error().message;
  return *file;
}
TensorFile added(const TensorFile& model, const TensorFile& style, bool replace = false) {
  const auto file = add_style(model, "m.safetensors", style, "s.safetensors", replace);
  EXPECT_TRUE(file.ok()) << file.error().message;
  return *file;
}
std::string rejection(const TensorFile& model, const TensorFile& style, bool replace = false) {
  const auto file = add_style(model, "m.safetensors", style, "s.safetensors", replace);
  return file.ok() ? "accepted" : file.error().message;
}

// All that the networks answer to a few windows with one style in force, bit for bit.
std::vector<uint32_t> answers(const TensorFile& file, const std::string& style) {
  const auto model = read(file);
  StyleNetworks networks(model);
  std::vector<float> strengths(model->styles().size());
  strengths[static_cast<size_t>(*model->find_style(style))] = 1;
  networks.set_strengths(strengths);
  std::vector<uint32_t> bits;
  const auto add = [&](float number) { bits.push_back(std::bit_cast<uint32_t>(number)); };
  for (const uint64_t seed : {1, 2, 3}) {
    networks.forward(window_of(1, seed), 0.5f);
    std::ranges::for_each(networks.pose(), add);
    std::ranges::for_each(networks.contact(), add);
    add(networks.log_rate());
    add(networks.gate());
  }
  return bits;
}

TEST(TrunkFingerprint, is_that_of_the_int8_twin_and_of_no_other_model) {
  EXPECT_EQ(trunk_fingerprint(test::shipped_model("panache.safetensors")),
            trunk_fingerprint(test::shipped_model("panache-int8.safetensors")));
  const TensorFile model = mixed_model();
  EXPECT_NE(trunk_fingerprint(model), trunk_fingerprint(mixed_model(2)));
  for (const char* key :
       {"input.mean", "input.scale", "output.scale", "pose.trunk.0.bias", "pose.trunk.1.bias"}) {
    TensorFile other = model;
    other.tensors[key].values.back() += 1;
    EXPECT_NE(trunk_fingerprint(other), trunk_fingerprint(model)) << key;
  }
}

TEST(TrunkFingerprint, stays_when_styles_come_and_go) {
  const TensorFile model = mixed_model();
  EXPECT_EQ(trunk_fingerprint(removed(model, "old")), trunk_fingerprint(model));
  EXPECT_EQ(trunk_fingerprint(removed(model, "limping")), trunk_fingerprint(model));
}

TEST(StyleFile, carries_its_styles_numbers_and_all_that_a_user_must_know) {
  TensorFile model = mixed_model();
  model.metadata["data"] = "our own takes";
  const TensorFile old = extract(model, "proud"), limping = extract(model, "limping");
  EXPECT_EQ(old.tensors.at("pose.head.weight").values,
            model.tensors.at("pose.head.1.weight").values);
  EXPECT_EQ(old.tensors.at("timing.head.bias").values,
            model.tensors.at("timing.head.1.bias").values);
  EXPECT_EQ(old.tensors.at("contact.head.bias").values,
            model.tensors.at("contact.head.2.bias").values);  // The first is of no style.
  EXPECT_EQ(old.tensors.size(), 6u);
  EXPECT_EQ(limping.tensors.at("gate.worth").values,
            model.tensors.at("learnt.0.gate.worth").values);
  EXPECT_TRUE(limping.tensors.at("head.weight").half);
  const std::map<std::string, std::string> given = {
      {"format", "panache-style"}, {"format_version", "1"},
      {"style", "limping"},        {"description", "looks limping"},
      {"origin", "limp.bvh"},      {"trunk", trunk_fingerprint(model)},
      {"data", "our own takes"},   {"licence", "CC0"}};
  EXPECT_EQ(limping.metadata, given);
  const auto info = read_style_info(limping, "s.safetensors");
  ASSERT_TRUE(info.ok()) << info.error().message;
  EXPECT_TRUE(info->learnt);
  EXPECT_EQ(info->origin, "limp.bvh");
  EXPECT_FALSE(read_style_info(old, "s.safetensors")->learnt);
}

TEST(StyleFile, every_tensor_of_a_learnt_style_comes_along) {
  const TensorFile rest = removed(removed(mixed_model(), "sneaking"), "limping");
  for (const auto& [key, tensor] : rest.tensors) EXPECT_FALSE(key.starts_with("learnt.")) << key;
  EXPECT_FALSE(rest.metadata.contains("style_origins"));
}

TEST(StyleFile, a_style_taken_out_and_put_back_moves_as_before_bit_for_bit) {
  const TensorFile whole = test::shipped_model("panache.safetensors");
  const TensorFile without = removed(whole, "old");
  EXPECT_EQ(read(without)->find_style("old").ok(), false);
  const TensorFile back = added(without, extract(whole, "old"));
  EXPECT_EQ(answers(back, "old"), answers(whole, "old"));
  EXPECT_EQ(format_safetensors(back).size(), format_safetensors(whole).size());
  for (const char* other : {"angry", "proud", "zombie"}) {
    EXPECT_EQ(answers(without, other), answers(whole, other)) << other;
    EXPECT_EQ(answers(back, other), answers(whole, other)) << other;
  }
}

TEST(StyleFile, a_learnt_style_taken_out_and_put_back_gives_the_same_file) {
  TensorFile whole = test::shipped_model("panache.safetensors");
  test::add_learnt(whole, 0, "swimming", "swim.bvh");
  const TensorFile without = removed(whole, "swimming"), style = extract(whole, "swimming");
  EXPECT_TRUE(format_safetensors(added(without, style)) == format_safetensors(whole));
  EXPECT_EQ(answers(added(removed(without, "old"), style), "swimming"), answers(whole, "swimming"));
}

TEST(StyleFile, is_small) {
  TensorFile model = test::shipped_model("panache.safetensors");
  test::add_learnt(model, 0, "swimming", "swim.bvh");
  for (const char* name : {"swimming", "old"}) {
    const TensorFile style = extract(model, name);
    EXPECT_LE(format_safetensors(style).size(), 110'000u) << name;
    EXPECT_LE(format_safetensors(quantize(style)).size(), 55'000u) << name;
  }
}

TEST(StyleFile, a_model_and_its_int8_twin_exchange_styles) {
  TensorFile whole = test::shipped_model("panache.safetensors");
  test::add_learnt(whole, 0, "swimming", "swim.bvh");
  const TensorFile half = quantize(whole);
  for (const char* name : {"old", "swimming"}) {
    const TensorFile style = extract(whole, name), half_style = extract(half, name);
    EXPECT_TRUE(format_safetensors(quantize(style)) == format_safetensors(half_style)) << name;
    EXPECT_TRUE(format_safetensors(added(half, half_style, true)) == format_safetensors(half));
    // Each model moves with the other's style, and nearly as with its own.
    const auto near = [&](const TensorFile& a, const TensorFile& b) {
      const std::vector<uint32_t> x = answers(a, name), y = answers(b, name);
      double apart = 0, size = 0;
      for (size_t i = 0; i < x.size(); ++i) {
        const double from = std::bit_cast<float>(x[i]), to = std::bit_cast<float>(y[i]);
        apart += (from - to) * (from - to), size += from * from;
      }
      EXPECT_GT(apart, 0) << name;
      // A weight is off by up to a 254th of the largest of its column.
      EXPECT_LT(std::sqrt(apart / size), 0.03) << name;
    };
    near(whole, added(whole, half_style, true));
    near(half, added(half, style, true));
  }
}

TEST(StyleFile, styles_go_behind_those_of_their_kind) {
  const TensorFile model = mixed_model();
  const TensorFile proud = extract(model, "proud"), limping = extract(model, "limping");
  const TensorFile two = removed(removed(model, "proud"), "limping");
  EXPECT_EQ(styles_of(two), (Names{"old", "sneaking"}));
  const TensorFile four = added(added(two, limping), proud);
  EXPECT_EQ(styles_of(four), (Names{"old", "proud", "sneaking", "limping"}));
  for (const std::string& name : styles_of(model)) {
    EXPECT_EQ(answers(four, name), answers(model, name)) << name;
  }
  EXPECT_EQ(read(four)->styles()[3].origin, "limp.bvh");
  EXPECT_EQ(read(four)->styles()[2].origin, "");
  EXPECT_EQ(read(four)->styles()[1].description, "looks proud");
}

std::string list(const TensorFile& file, std::string StyleInfo::*what) {
  std::string all;
  const auto model = read(file);
  for (const StyleInfo& style : model->styles()) all += style.*what + "|";
  return all;
}
std::string groups_of(const TensorFile& file) { return list(file, &StyleInfo::group); }
std::string sides_of(const TensorFile& file) { return list(file, &StyleInfo::side); }

TEST(StyleFile, styles_keep_their_groups_wherever_they_go) {
  TensorFile model = mixed_model();
  ASSERT_EQ(styles_of(model), (Names{"old", "proud", "limping", "sneaking"}));
  const TensorFile plain = extract(model, "proud");
  EXPECT_FALSE(plain.metadata.contains("group"));
  model.metadata["style_groups"] = "ages\nmoods\n\n\n";
  const TensorFile proud = extract(model, "proud"), limping = extract(model, "limping");
  EXPECT_EQ(read_style_info(proud, "proud")->group, "moods");
  EXPECT_EQ(read_style_info(limping, "limping")->group, "");
  EXPECT_EQ(groups_of(removed(model, "proud")), "ages|||");
  EXPECT_EQ(groups_of(added(removed(model, "proud"), proud)), "ages|moods|||");
  EXPECT_EQ(groups_of(added(removed(model, "limping"), limping)), "ages|moods|||");
  EXPECT_EQ(groups_of(added(model, plain, true)), "ages||||");
  EXPECT_EQ(groups_of(*rename_style(model, "old", "aged", "m.safetensors")), "ages|moods|||");
  // With the last group goes the list.
  EXPECT_FALSE(removed(removed(model, "proud"), "old").metadata.contains("style_groups"));
  // A model without groups gets them with the first style that has one.
  EXPECT_EQ(groups_of(added(removed(mixed_model(), "proud"), proud)), "|moods|||");
}

TEST(StyleFile, styles_keep_their_sides_wherever_they_go) {
  TensorFile model = mixed_model();
  model.metadata["style_sides"] = "right leg\nto the left\n\n\n";
  const TensorFile proud = extract(model, "proud");
  EXPECT_EQ(read_style_info(proud, "proud")->side, "to the left");
  EXPECT_FALSE(extract(model, "limping").metadata.contains("side"));
  EXPECT_EQ(sides_of(removed(model, "proud")), "right leg|||");
  EXPECT_EQ(sides_of(added(removed(model, "proud"), proud)), "right leg|to the left|||");
  EXPECT_EQ(sides_of(*rename_style(model, "old", "aged", "m")), "right leg|to the left|||");
  TensorFile broken = proud;
  broken.metadata["side"] = "both arms";
  EXPECT_EQ(read_style_info(broken, "p.safetensors").error().message,
            "p.safetensors: metadata 'side': 'both arms'; expected a phrase with the word left or "
            "right in it once, such as 'left leg'");
}

TEST(StyleFile, styles_keep_their_other_words_wherever_they_go) {
  TensorFile model = mixed_model();
  model.metadata["style_words"] = "elderly\nvain cocky\n\n\n";
  const TensorFile proud = extract(model, "proud");
  EXPECT_EQ(read_style_info(proud, "proud")->words, "vain cocky");
  EXPECT_EQ(*read(added(removed(model, "proud"), proud))->find_style_by_any_name("cocky"), 1);
  EXPECT_EQ(removed(model, "proud").metadata.at("style_words"), "elderly\n\n\n");
}

// A clip may be called anything, and no one should have to rename it before its style can be kept.
TEST(StyleFile, of_any_description_and_origin_goes_into_a_model) {
  const TensorFile model = mixed_model();
  const TensorFile style =
      make_style_file(model, {"drunk", "one\ntwo, müde", "w\xe4lk\x1b.bvh", true},
                      extract(model, "limping").tensors);
  const auto merged = read(added(model, style));
  EXPECT_EQ(merged->styles().back().description, "one two, müde");
  EXPECT_EQ(merged->styles().back().origin, "w?lk .bvh");
}

TEST(StyleFile, a_style_of_the_same_name_is_replaced_in_its_place_when_asked) {
  const TensorFile model = mixed_model();
  TensorFile proud = extract(model, "proud"), limping = extract(model, "limping");
  proud.metadata["style"] = "old", limping.metadata["style"] = "proud";
  EXPECT_EQ(
      rejection(model, proud),
      "m.safetensors: has a style 'old' already; replace it or give one of the two another name");
  const TensorFile same_kind = added(model, proud, true);
  EXPECT_EQ(styles_of(same_kind), styles_of(model));
  EXPECT_EQ(answers(same_kind, "old"), answers(model, "proud"));
  const TensorFile other_kind = added(model, limping, true);
  EXPECT_EQ(styles_of(other_kind), (Names{"old", "limping", "sneaking", "proud"}));
  EXPECT_EQ(answers(other_kind, "proud"), answers(model, "limping"));
}

TEST(StyleFile, a_model_may_keep_learnt_styles_only) {
  const TensorFile rest = removed(removed(mixed_model(), "old"), "proud");
  EXPECT_EQ(styles_of(rest), (Names{"limping", "sneaking"}));
  EXPECT_EQ(answers(rest, "limping"), answers(mixed_model(), "limping"));
}

TEST(StyleFile, one_that_was_made_with_another_model_is_rejected_with_the_cure) {
  const TensorFile model = mixed_model(), other = mixed_model(2);
  EXPECT_EQ(
      rejection(model, extract(other, "limping"), true),
      "s.safetensors: is a style of another model (its trunk is '" + trunk_fingerprint(other) +
          "', that of m.safetensors is '" + trunk_fingerprint(model) +
          "'); use it with the model that it was made with or the int8 version of that model, "
          "or learn it again with this one");
}

TEST(StyleFile, a_model_that_cannot_learn_takes_no_learnt_style) {
  EXPECT_EQ(rejection(test::make_model({"old"}), extract(mixed_model(), "limping")),
            "m.safetensors with s.safetensors: has tensors 'learnt.0.*' of a learnt style, but no "
            "'learn.mean' and 'learn.scale'");
}

TEST(StyleFile, a_model_takes_255_styles_and_no_more) {
  std::vector<std::string> names;
  for (int i = 0; i < 254; ++i) names.push_back("style" + std::to_string(i));
  TensorFile style = extract(mixed_model(), "old");
  const TensorFile full = added(test::make_model(names), style);
  style.metadata["style"] = "young";
  EXPECT_EQ(rejection(full, style),
            "m.safetensors with s.safetensors: has 256 styles; expected at most 255");
}

TEST(StyleFile, a_model_without_heads_gives_and_takes_no_styles) {
  const TensorFile model = test::make_model({"old", "proud"}, 1, test::kSmith2019);
  const std::string message =
      "m.safetensors: is of recipe smith2019, whose styles are inputs of all its layers; expected "
      "a model of recipe panache, where each has a head of its own";
  EXPECT_EQ(extract_style(model, "old", "m.safetensors").error().message, message);
  EXPECT_EQ(remove_style(model, "old", "m.safetensors").error().message, message);
  EXPECT_EQ(rejection(model, extract(mixed_model(), "old")), message);
}

TEST(StyleFile, a_style_that_is_not_there_is_neither_extracted_nor_removed) {
  const std::string message = "unknown style 'prou'; the nearest is proud";
  EXPECT_EQ(extract_style(mixed_model(), "prou", "m").error().message, message);
  EXPECT_EQ(remove_style(mixed_model(), "prou", "m").error().message, message);
  EXPECT_EQ(rename_style(mixed_model(), "prou", "sad", "m").error().message, message);
}

TEST(StyleFile, a_model_that_is_broken_gives_and_takes_no_styles) {
  const TensorFile style = extract(mixed_model(), "old");
  TensorFile broken = mixed_model();
  broken.tensors.erase("input.mean");
  const std::string message = "m.safetensors: tensor 'input.mean' is missing";
  EXPECT_EQ(extract_style(broken, "old", "m.safetensors").error().message, message);
  EXPECT_EQ(rejection(broken, style), message);
  EXPECT_EQ(remove_style(broken, "old", "m.safetensors").error().message, message);
  EXPECT_EQ(rename_style(broken, "old", "sad", "m.safetensors").error().message, message);
}

TEST(StyleFile, the_last_style_stays) {
  EXPECT_EQ(remove_style(test::make_model({"old"}), "old", "m.safetensors").error().message,
            "m.safetensors: has no style but 'old'; a model keeps at least one");
}

TEST(StyleFile, a_renamed_style_is_the_same_under_another_name) {
  for (const Recipe* recipe : {&test::kPanache, &test::kSmith2019}) {
    const TensorFile model = test::make_model({"old", "proud"}, 1, *recipe);
    const auto renamed = rename_style(model, "old", "old, very", "m");
    EXPECT_FALSE(renamed.ok());
    const auto good = rename_style(model, "old", "altväterlich", "m");
    ASSERT_TRUE(good.ok()) << good.error().message;
    EXPECT_EQ(styles_of(*good), (Names{"altväterlich", "proud"}));
    EXPECT_EQ(read(*good)->styles()[0].description, "looks old");
    TensorFile same = *good;
    same.metadata = model.metadata;
    EXPECT_TRUE(format_safetensors(same) == format_safetensors(model));
  }
  EXPECT_EQ(rename_style(mixed_model(), "old", "limping", "m").error().message,
            "m: has a style 'limping' already");
  EXPECT_EQ(read(*rename_style(mixed_model(), "limping", "lame", "m"))->styles()[2].origin,
            "limp.bvh");
}

TEST(StyleName, holds_what_a_command_line_and_a_table_can_say) {
  const auto rejection = [](const std::string& name) {
    const auto fit = check_style_name(name);
    return fit.ok() ? "" : fit.error().message;
  };
  for (const std::string good :
       {"old", "very old", "altväterlich", "年老", "a.b/c", "1..0", "\"x\""}) {
    EXPECT_EQ(rejection(good), "");
  }
  EXPECT_EQ(rejection(std::string(60, 'a')), "");
  EXPECT_EQ(rejection(""), "style name '': is empty");
  EXPECT_EQ(rejection(std::string(61, 'a')),
            "style name '" + std::string(40, 'a') + "...': has 61 bytes; expected at most 60");
  EXPECT_EQ(rejection("a=1"),
            "style name 'a=1': holds a '=', which separates names from strengths");
  EXPECT_EQ(rejection("a,b"),
            "style name 'a,b': holds a ',', which separates names from strengths");
  for (const std::string torn :
       {"a\nb", "a\rb", "a\tb", "a\x1b[2J", "a\x7f", "\xff", "\xed\xa0\x80"}) {
    EXPECT_TRUE(rejection(torn).ends_with(": is not one line of UTF-8 text")) << rejection(torn);
  }
  EXPECT_EQ(rejection(std::string("a\0b", 3)),
            "style name 'a\\x00b': is not one line of UTF-8 text");
  EXPECT_EQ(rejection("old "), "style name 'old ': begins or ends with a space");
  EXPECT_EQ(rejection(" old"), "style name ' old': begins or ends with a space");
  EXPECT_EQ(rejection("-old"), "style name '-old': must not start with '-'");
  EXPECT_EQ(rejection("seconds"),
            "style name 'seconds': is the name of the time column in tables of strengths");
}

TEST(StyleFile, from_a_stranger_is_rejected_where_anything_is_wrong_with_it) {
  const TensorFile model = removed(mixed_model(), "limping");
  const auto metadata = [](const std::string& key, const std::string& text) {
    return [=](TensorFile& s) { s.metadata[key] = text; };
  };
  const std::string one_line = "' is not one line of UTF-8 text";
  const std::string merged = "m.safetensors with s.safetensors: ";
  const std::pair<std::function<void(TensorFile&)>, std::string> cases[] = {
      {[](TensorFile&) {}, "accepted"},
      {[](TensorFile& s) { s.metadata.clear(); },
       "s.safetensors: is a safetensors file, but not a style; expected metadata 'format' to be "
       "'panache-style'"},
      {metadata("format", "panache"), "s.safetensors: is a model; expected a style file"},
      {metadata("format_version", "2"),
       "s.safetensors: is a style file of format version '2'; this program reads version 1"},
      {metadata("style", "a=b"),
       "s.safetensors: style name 'a=b': holds a '=', which separates names from strengths"},
      {metadata("description", "one\ntwo"), "s.safetensors: metadata 'description" + one_line},
      {metadata("origin", "\x1b[2J"), "s.safetensors: metadata 'origin" + one_line},
      {metadata("group", "moods\nages"), "s.safetensors: metadata 'group" + one_line},
      {[](TensorFile& s) { s.tensors["pose.trunk.0.bias"] = test::constant_tensor(16, 0); },
       "s.safetensors: has 8 tensors, of which 7 are those of a style; expected no others"},
      {[](TensorFile& s) { s.tensors.clear(); },
       "s.safetensors: has 0 tensors, of which 0 are those of a style; expected no others"},
      {[](TensorFile& s) { s.tensors["head.bias"].values[3] = NAN; },
       "s.safetensors: tensor 'head.bias' holds a number that is not finite"},
      {[](TensorFile& s) { s.tensors["mean"] = test::constant_tensor(3, 0); },
       merged + "tensor 'learnt.1.mean' has shape [3]; expected [32]"},
      {[](TensorFile& s) { s.tensors.erase("gate.worth"); },
       merged + "tensor 'learnt.1.gate.worth' is missing"}};
  for (const auto& [spoil, message] : cases) {
    TensorFile style = extract(mixed_model(), "limping");
    spoil(style);
    EXPECT_EQ(rejection(model, style), message);
  }
}

// A style file of random bytes changed is rejected or gives a model that can be read.
TEST(StyleFile, damaged_anywhere_does_no_harm) {
  const TensorFile model = mixed_model(), style = extract(mixed_model(), "old");
  const std::string bytes = format_safetensors(style);
  for (size_t size = 0; size < bytes.size(); size += 61) {
    EXPECT_FALSE(parse_safetensors(bytes.substr(0, size), "s").ok()) << size;
  }
  int accepted = 0;
  for (size_t at = 0; at < bytes.size(); at += at < 1400 ? 2 : 97) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ "\x01\x10\x80"[at % 3]);
    const auto file = parse_safetensors(damaged, "s");
    if (!file) continue;
    const auto merged = add_style(model, "m", *file, "s", true);
    if (!merged) continue;
    ++accepted;
    ASSERT_TRUE(Model::parse(format_safetensors(*merged), "m").ok()) << at;
  }
  EXPECT_GT(accepted, 0);  // Some bytes are but weights.
}

}  // namespace
}  // namespace panache

#pragma once
// The shipped model and the samples' stick figure, for tests of the C interface.

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "../../samples/common/stick_figure.h"

namespace panache::test {

// The bytes of a shipped model.
inline std::string file_bytes(const char* name) {
  std::ifstream file(std::string(PANACHE_SOURCE_DIR "/models/") + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}
inline std::string model_bytes() { return file_bytes("panache.safetensors"); }

// An object of the C interface that is destroyed with its owner.
struct Destroy {
  void operator()(panache_bytes* one) const { panache_bytes_destroy(one); }
  void operator()(panache_character* one) const { panache_character_destroy(one); }
  void operator()(panache_learnt* one) const { panache_learnt_destroy(one); }
  void operator()(panache_model* one) const { panache_model_destroy(one); }
  void operator()(panache_motion_file* one) const { panache_motion_file_destroy(one); }
  void operator()(panache_samples* one) const { panache_samples_destroy(one); }
  void operator()(panache_skeleton* one) const { panache_skeleton_destroy(one); }
  void operator()(panache_styled_clip* one) const { panache_styled_clip_destroy(one); }
};
template <class T>
using Owned = std::unique_ptr<T, Destroy>;

// What `create` puts where its argument points; where it fails the test fails, and it is null.
template <class T, class Create>
Owned<T> created(const Create& create) {
  T* out = nullptr;
  EXPECT_EQ(create(&out), PANACHE_OK) << panache_last_error();
  return Owned<T>(out);
}
// The message with which `create` fails; it must fail with `status` and create nothing.
template <class T, class Create>
std::string rejection(panache_status status, const Create& create) {
  char other = 0;
  T* out = reinterpret_cast<T*>(&other);
  EXPECT_EQ(create(&out), status) << panache_last_error();
  EXPECT_EQ(out, nullptr);
  return panache_last_error();
}

inline Owned<panache_model> model_of(const std::string& bytes) {
  return created<panache_model>(
      [&](auto** out) { return panache_model_create(bytes.data(), bytes.size(), out); });
}
inline Owned<panache_model> shipped_remover() {
  return model_of(file_bytes("remover-int8.safetensors"));
}
inline std::string text_of(const Owned<panache_bytes>& bytes) {
  if (!bytes) return "";
  return {static_cast<const char*>(panache_bytes_data(bytes.get())),
          panache_bytes_size(bytes.get())};
}
// The model with what was learnt.
inline std::string text_of(const Owned<panache_learnt>& learnt) {
  if (!learnt) return "";
  size_t size = 0;
  const void* bytes = panache_learnt_model(learnt.get(), &size);
  return {static_cast<const char*>(bytes), size};
}

// The model file with another list in its metadata, in place of its own. `lines` is escaped for
// JSON.
inline std::string with_list(std::string model, const std::string& key, const std::string& lines) {
  const size_t own = model.find('"' + key + '"');
  if (own != std::string::npos) model[own + 1] = 'x';
  std::string entry = '"' + key + "\":\"" + lines + "\",";
  entry.resize((entry.size() + 7) / 8 * 8, ' ');  // Tensors stay aligned.
  uint64_t size = 0;
  std::memcpy(&size, model.data(), sizeof(size));
  size += entry.size();
  const std::string metadata = "\"__metadata__\":{";
  const size_t begin = model.find(metadata) + metadata.size();
  std::string out(reinterpret_cast<const char*>(&size), sizeof(size));
  return out + model.substr(sizeof(size), begin - sizeof(size)) + entry + model.substr(begin);
}

// The stick figure's walk as a BVH file in centimetres; its joints turn about x alone.
inline std::string walk_bvh(int frames) {
  std::ostringstream out;
  out << std::fixed << "HIERARCHY\n";
  int open = 0;
  const auto depth = [](int joint) {
    int d = 0;
    while ((joint = stick_figure[joint].parent) >= 0) ++d;
    return d;
  };
  for (int j = 0; j < STICK_JOINTS; ++j) {
    for (; open > depth(j); --open) out << "}\n";
    const float* v = stick_figure[j].translation;
    out << (j ? "JOINT " : "ROOT ") << stick_figure[j].name << "\n{\nOFFSET " << 100 * v[0] << ' '
        << 100 * v[1] << ' ' << 100 * v[2] << "\nCHANNELS "
        << (j ? "3 " : "6 Xposition Yposition Zposition ") << "Xrotation Yrotation Zrotation\n";
    ++open;
    if (j + 1 == STICK_JOINTS || stick_figure[j + 1].parent != j) {
      out << "End Site\n{\nOFFSET 0 0 5\n}\n";
    }
  }
  for (; open > 0; --open) out << "}\n";
  out << "MOTION\nFrames: " << frames << "\nFrame Time: 0.016667\n";
  for (int f = 0; f < frames; ++f) {
    stick_pose pose;
    stick_walk(f / 60.0, 0, &pose);
    for (const float x : pose.translations[0]) out << 100 * x << ' ';
    for (int j = 0; j < STICK_JOINTS; ++j) {
      const double angle = 2 * std::atan2(pose.rotations[j][0], pose.rotations[j][3]);
      out << angle * 180 / M_PI << " 0 0" << (j + 1 < STICK_JOINTS ? " " : "\n");
    }
  }
  return out.str();
}

// A walk of the stick figure, and the same bent forward at its first joint above the hips.
struct Walk {
  std::vector<float> rotations, translations;
  panache_clip clip{};
  Walk(const panache_skeleton* skeleton, int frames, bool bent) {
    for (int f = 0; f < frames; ++f) {
      stick_pose pose;
      stick_walk(f / 60.0, 0, &pose);
      const panache_input_pose in = stick_input(&pose);
      rotations.insert(rotations.end(), in.rotations, in.rotations + 4 * STICK_JOINTS);
      translations.insert(translations.end(), in.translations, in.translations + 3 * STICK_JOINTS);
      if (bent) {  // By 0.4 radians about x; the walk leaves this joint alone.
        float* q = &rotations[rotations.size() - 4 * (STICK_JOINTS - 1)];
        q[0] = std::sin(0.2f), q[1] = 0, q[2] = 0, q[3] = std::cos(0.2f);
      }
    }
    clip = {skeleton, frames, 1 / 60.0, rotations.data(), translations.data()};
  }
};

class StickApi : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(model_ && skeleton_); }
  // Lives as long as the test.
  panache_character* character(const char* style = nullptr, float strength = 1,
                               const panache_character_options* options = nullptr) {
    characters_.push_back(created<panache_character>([&](auto** out) {
      return panache_character_create(model_.get(), skeleton_.get(), options, out);
    }));
    panache_character* out = characters_.back().get();
    if (style) panache_character_set_strength(out, style_of(style), strength);
    return out;
  }
  int32_t style_of(const char* name) const { return panache_model_find_style(model_.get(), name); }
  // A walk as a clip of the figure.
  Walk clip(int frames, bool bent = false) const { return {skeleton_.get(), frames, bent}; }
  // A clip with one style; null where that fails.
  Owned<panache_styled_clip> stylize(const panache_clip& clip, const char* style,
                                     const std::vector<panache_strength_key>& keys = {{0, 1}},
                                     const panache_stylize_options* options = nullptr) const {
    const panache_strength_track track = {style_of(style), static_cast<int32_t>(keys.size()),
                                          keys.data()};
    return created<panache_styled_clip>([&](auto** out) {
      return panache_stylize_clip(model_.get(), &clip, &track, 1, options, out);
    });
  }
  static std::vector<stick_pose> walk(panache_character* character, int frames, double phase = 0) {
    std::vector<stick_pose> out(static_cast<size_t>(frames));
    for (int f = 0; f < frames; ++f) {
      stick_pose in;
      stick_walk(f / 60.0, phase, &in);
      panache_character_step(character, stick_input(&in), 1 / 60.0, stick_output(&out[f]));
    }
    return out;
  }
  static bool same(const std::vector<stick_pose>& a, const std::vector<stick_pose>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
  }

  Owned<panache_model> model_ = model_of(model_bytes());
  Owned<panache_skeleton> skeleton_ = created<panache_skeleton>(
      [](auto** out) { return panache_skeleton_create(stick_figure, STICK_JOINTS, nullptr, out); });

 private:
  std::vector<Owned<panache_character>> characters_;
};

inline panache_style_info info_of(const panache_model* model, int32_t style) {
  panache_style_info info = PANACHE_STYLE_INFO;
  EXPECT_EQ(panache_model_get_style_info(model, style, &info), PANACHE_OK) << panache_last_error();
  return info;
}

inline panache_report report_of(const panache_character* character) {
  panache_report report = PANACHE_REPORT;
  EXPECT_EQ(panache_character_get_report(character, &report), PANACHE_OK);
  return report;
}

}  // namespace panache::test

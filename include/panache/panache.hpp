// Panache for C++17 and newer: the objects of panache.h with destructors, and exceptions.
//
//     panache::Model model(bytes, size);              // shared by all characters
//     panache::Skeleton skeleton(joints, count);      // shared by all with the same rig
//     panache::Character character(model, skeleton);  // one for each
//     character.set_strength(model.find_style("old"), 1);
//     each frame: character.step({in_rotations, in_translations}, 1.0 / 60,
//                                {out_rotations, out_translations});
//
// Shapes, units, ranges and lifetimes are those of the functions of panache.h with the same names.
// Arguments are pointers and counts, or structs of panache.h. Objects can be moved but not copied;
// a moved-from object may only be destroyed or assigned to. get() gives the handle, for what this
// header leaves out. Functions that can fail throw panache::Error; step() and step_many() cannot.
// All of this is inline: no C++ crosses the border of the library, so compilers may differ.
#ifndef PANACHE_PANACHE_HPP_
#define PANACHE_PANACHE_HPP_

#include <panache/panache.h>

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace panache {
// The static library has classes of its own in namespace panache. Other symbols keep the two apart.
inline namespace over_c {

// A failure: what() is the sentence of panache_last_error().
class Error : public std::runtime_error {
 public:
  explicit Error(panache_status status)
      : Error(status, panache_last_error(), panache_last_error_kind()) {}
  Error(panache_status status, const std::string& message, panache_error_kind kind)
      : std::runtime_error(message), status_(status), kind_(kind) {}
  panache_status status() const noexcept { return status_; }
  panache_error_kind kind() const noexcept { return kind_; }

 private:
  panache_status status_;
  panache_error_kind kind_;
};

// Throws where a function of panache.h failed.
inline void check(panache_status status) {
  if (status != PANACHE_OK) throw Error(status);
}

// Owns a handle of panache.h.
template <class T, void (*kDestroy)(T*)>
class Object {
 public:
  // Takes a handle over.
  explicit Object(T* handle) noexcept : handle_(handle) {}
  // Creates it: create(first, others..., &handle).
  template <class Create, class First, class... Others>
  Object(Create create, const First& first, const Others&... others) {
    T* handle = nullptr;
    check(create(first, others..., &handle));
    handle_.reset(handle);
  }
  T* get() const noexcept { return handle_.get(); }

 private:
  struct Destroy {
    void operator()(T* handle) const noexcept { kDestroy(handle); }
  };
  std::unique_ptr<T, Destroy> handle_;
};

// The content of a file that the library made.
class Bytes : public Object<panache_bytes, panache_bytes_destroy> {
 public:
  using Object::Object;
  const void* data() const noexcept { return panache_bytes_data(get()); }
  size_t size() const noexcept { return panache_bytes_size(get()); }
};

class Model : public Object<panache_model, panache_model_destroy> {
 public:
  // Reads a model from the bytes of its file, which may go afterwards.
  Model(const void* bytes, size_t size) : Object(panache_model_create, bytes, size) {}
  int style_count() const noexcept { return panache_model_style_count(get()); }
  // NULL where no style is at that place.
  const char* style_name(int style) const noexcept {
    return panache_model_style_name(get(), style);
  }
  panache_style_info style_info(int style) const {
    panache_style_info out = PANACHE_STYLE_INFO;
    check(panache_model_get_style_info(get(), style, &out));
    return out;
  }
  // The side that "captured", "mirrored", "left" or "right" names.
  float find_side(int style, const std::string& word) const {
    float side = 1;
    check(panache_model_find_side(get(), style, word.c_str(), &side));
    return side;
  }
  // NULL where the style has no such gesture.
  const char* gesture_name(int style, int gesture) const noexcept {
    return panache_model_gesture_name(get(), style, gesture);
  }
  // The place of a style, by its name or another word for it. Throws PANACHE_BAD_ARGUMENT where the
  // model has none.
  int find_style(const std::string& name) const {
    const int place = panache_model_find_style(get(), name.c_str());
    if (place >= 0) return place;
    throw Error(PANACHE_BAD_ARGUMENT, panache_last_error(), panache_last_error_kind());
  }
};

class Skeleton : public Object<panache_skeleton, panache_skeleton_destroy> {
 public:
  using Object::Object;
  // `options` may be null.
  Skeleton(const panache_joint* joints, int joint_count,
           const panache_skeleton_options* options = nullptr)
      : Object(panache_skeleton_create, joints, joint_count, options) {}
  int joint_count() const noexcept { return panache_skeleton_joint_count(get()); }
  // The place of a joint of the humanoid ("leftHand"), or -1.
  int find(const char* vrm_name) const noexcept { return panache_skeleton_find(get(), vrm_name); }
};

class Character : public Object<panache_character, panache_character_destroy> {
 public:
  // `options` may be null.
  Character(const Model& model, const Skeleton& skeleton,
            const panache_character_options* options = nullptr)
      : Object(panache_character_create, model.get(), skeleton.get(), options) {}
  void set_strength(int style, float strength) noexcept {
    panache_character_set_strength(get(), style, strength);
  }
  // 1 as captured, -1 mirrored.
  void set_side(int style, float side) noexcept {
    panache_character_set_side(get(), style, side);
  }
  // A style of the options' remover, taken off the input; -1: none.
  void set_removed(int style) noexcept { panache_character_set_removed(get(), style); }
  // False where the model has no such gesture.
  bool trigger(int style, int gesture) noexcept {
    return panache_character_trigger(get(), style, gesture) != 0;
  }
  void set_person(std::uint32_t seed, float amount = 1) {
    check(panache_character_set_person(get(), seed, amount));
  }
  // numbers[count]
  void set_person(const float* numbers, int count) {
    check(panache_character_set_person_numbers(get(), numbers, count));
  }
  void set_shape(const panache_shape& shape) { check(panache_character_set_shape(get(), &shape)); }
  void step(panache_input_pose in, double seconds, panache_output_pose out) noexcept {
    panache_character_step(get(), in, seconds, out);
  }
  void reset() noexcept { panache_character_reset(get()); }
  panache_report report() const {
    panache_report out = PANACHE_REPORT;
    check(panache_character_get_report(get(), &out));
    return out;
  }
  // The character's memory, to return to this moment; for memory, not for files.
  std::vector<unsigned char> save() const {
    std::vector<unsigned char> state(panache_character_state_size(get()));
    panache_character_save(get(), state.data());
    return state;
  }
  void restore(const std::vector<unsigned char>& state) {
    check(panache_character_restore(get(), state.data(), state.size()));
  }
};

// Steps `count` characters, in[i] into out[i]; their handles stand side by side (Character::get()).
inline void step_many(panache_character* const* characters, int count, const panache_input_pose* in,
                      double seconds, const panache_output_pose* out) noexcept {
  panache_step_many(characters, count, in, seconds, out);
}

// A clip that the library made. What it points to lives as long as it does.
class StyledClip : public Object<panache_styled_clip, panache_styled_clip_destroy> {
 public:
  using Object::Object;
  int frame_count() const noexcept { return panache_styled_clip_frame_count(get()); }
  // [frame_count][joint_count][4] and [frame_count][joint_count][3]
  const float* rotations() const noexcept { return panache_styled_clip_rotations(get()); }
  const float* translations() const noexcept { return panache_styled_clip_translations(get()); }
  // The frame of the input that each frame shows, with fractions. [frame_count]
  const double* source_frames() const noexcept { return panache_styled_clip_source_frames(get()); }
  // 1 where the left and the right foot are planted, else 0. [frame_count][2]
  const uint8_t* contacts() const noexcept { return panache_styled_clip_contacts(get()); }
  // 1: motion like what the model knows; 0: unlike. [frame_count]
  const float* gates() const noexcept { return panache_styled_clip_gates(get()); }
  bool is_loop() const noexcept { return panache_styled_clip_is_loop(get()) != 0; }
};

// Styles a whole clip; strengths of tracks of one style add up. `options` may be null.
inline StyledClip stylize(const Model& model, const panache_clip& clip,
                          const panache_strength_track* tracks, int track_count,
                          const panache_stylize_options* options = nullptr) {
  return StyledClip(panache_stylize_clip, model.get(), &clip, tracks, track_count, options);
}

// How much of a clip shows each style of a remover and, last, neutral; together 1.
inline std::vector<float> recognise_styles(const Model& remover, const panache_clip& clip) {
  std::vector<float> shares(static_cast<size_t>(panache_model_style_count(remover.get())) + 1);
  check(panache_recognise_styles(remover.get(), &clip, shares.data(),
                                 static_cast<int32_t>(shares.size())));
  return shares;
}

// Puts a clip on another skeleton. `options` may be null.
inline StyledClip retarget(const panache_clip& clip, const Skeleton& onto,
                           const panache_retarget_options* options = nullptr) {
  return StyledClip(panache_retarget_clip, &clip, onto.get(), options);
}

// A motion file as a whole: BVH, GLB, glTF, VRM, VRMA, AMC or FBX, by the extension of `name`.
class MotionFile : public Object<panache_motion_file, panache_motion_file_destroy> {
 public:
  MotionFile(const void* bytes, size_t size, const std::string& name)
      : Object(panache_motion_file_create, bytes, size, name.c_str()) {}
  int joint_count() const noexcept { return panache_motion_file_joint_count(get()); }
  int clip_count() const noexcept { return panache_motion_file_clip_count(get()); }
  // NULL where there is no motion at that place.
  const char* clip_name(int clip) const noexcept {
    return panache_motion_file_clip_name(get(), clip);
  }
  // A skeleton for a motion, or for the character where `clip` is -1. `options` may be null.
  Skeleton skeleton(int clip, const panache_skeleton_options* options = nullptr) const {
    return Skeleton(panache_motion_file_create_skeleton, get(), clip, options);
  }
  // A motion on this skeleton, whose arrays live as long as the file. -1: one frame at rest.
  panache_clip clip(int clip, const Skeleton& skeleton) const {
    panache_clip out = {};
    check(panache_motion_file_get_clip(get(), clip, &out));
    out.skeleton = skeleton.get();
    return out;
  }
  // The bytes of the file with new frames in it.
  Bytes write(const panache_clip_edit* edits, int edit_count, panache_edit_mode mode) const {
    return Bytes(panache_motion_file_write, get(), edits, edit_count, mode);
  }
};

// Learns a style from pairs of clips: the bytes of the model with it, and how well it went.
class Learnt : public Object<panache_learnt, panache_learnt_destroy> {
 public:
  Learnt(const void* model_bytes, size_t model_size, const panache_pair* pairs, int pair_count,
         const std::string& name, bool replace = false)
      : Object(panache_learn, model_bytes, model_size, pairs, pair_count, name.c_str(),
               static_cast<int32_t>(replace)) {}
  // From a clip in the style alone.
  Learnt(const void* model_bytes, size_t model_size, const void* bank_bytes, size_t bank_size,
         const panache_clip& styled, const std::string& name, bool replace = false)
      : Object(panache_learn_alone, model_bytes, model_size, bank_bytes, bank_size, &styled,
               name.c_str(), static_cast<int32_t>(replace)) {}
  // Valid as long as this object; `size` is set.
  const void* model(size_t& size) const noexcept { return panache_learnt_model(get(), &size); }
  const char* verdict() const noexcept { return panache_learnt_verdict(get()); }
  panache_learnt_report report() const {
    panache_learnt_report out = PANACHE_LEARNT_REPORT;
    check(panache_learnt_get_report(get(), &out));
    return out;
  }
};

}  // namespace over_c
}  // namespace panache

#endif  // PANACHE_PANACHE_HPP_

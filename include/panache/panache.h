/* Panache: gives the motion of a character a style, live. The whole interface of the library.
 *
 *     panache_model *model = NULL;           (shared by all characters)
 *     panache_skeleton *skeleton = NULL;     (shared by all characters with the same rig)
 *     panache_character *character = NULL;   (one for each)
 *     panache_model_create(bytes, size, &model);
 *     panache_skeleton_create(joints, joint_count, NULL, &skeleton);
 *     panache_character_create(model, skeleton, NULL, &character);
 *     panache_character_set_strength(character, panache_model_find_style(model, "old"), 1.0f);
 *     each frame: panache_character_step(character, in, 1.0 / 60, out);
 *
 * Conventions. Rotations are unit quaternions x, y, z, w and translations three numbers, both of a
 * joint relative to its parent, in the units and axes of the skeleton itself (any; they are found,
 * or told). Joints stand in the order in which the skeleton was given, parents before children.
 * Seconds are double. Strings are UTF-8 and end with a zero.
 *
 * Errors. Functions that can fail return a panache_status; panache_last_error() then says what
 * was wrong. Whatever they were to create is NULL then. Functions that cannot fail
 * return what they are asked for, or nothing. Arguments are not checked for NULL unless it says so.
 *
 * Memory. What a _create function gives is the caller's, to be given back to the _destroy function
 * of its kind, in any order: characters keep the model and skeleton that they need. The library
 * keeps no pointer that it was given. Stepping allocates nothing, locks nothing, and cannot fail.
 *
 * Versions. Options, shapes and reports begin with struct_size, their size in the header that the
 * program was compiled with: start them with the macro of their name. Fields are only ever added at
 * their ends, so programs keep running with newer libraries (docs/abi.md). A struct_size that is 0,
 * or fields that the library does not know and that are not 0, are a PANACHE_BAD_ARGUMENT. All
 * other structs never change.
 *
 * Threads. Models and skeletons may be used by any number of threads at once, a character by one at
 * a time. Equal inputs give the same bits on every instruction set.
 */
#ifndef PANACHE_PANACHE_H_
#define PANACHE_PANACHE_H_

#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32)
#if defined(PANACHE_BUILDS_SHARED)
#define PANACHE_API __declspec(dllexport)
#elif defined(PANACHE_USES_SHARED)
#define PANACHE_API __declspec(dllimport)
#else
#define PANACHE_API
#endif
#elif defined(__EMSCRIPTEN__)
#define PANACHE_API __attribute__((visibility("default"), used))
#else
#define PANACHE_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Versions and errors -------------------------------------------------------------------- */

/* The version of this header. Programs run with any library of the same major version (of the same
 * minor version while the major one is 0) that is no older. */
#define PANACHE_VERSION_MAJOR 0
#define PANACHE_VERSION_MINOR 2
#define PANACHE_VERSION_PATCH 0

/* The library's own version: 10000 major + 100 minor + patch. */
PANACHE_API int32_t panache_version(void);

typedef enum panache_status {
  PANACHE_OK = 0,
  PANACHE_BAD_MODEL = 1,    /* The bytes are no model that this library can use. */
  PANACHE_BAD_SKELETON = 2, /* The joints are no skeleton, or no humanoid. */
  PANACHE_BAD_ARGUMENT = 3, /* An option is out of its range. */
  PANACHE_BAD_STATE = 4,    /* The bytes are no state of such a character. */
  PANACHE_NO_MEMORY = 5,
  PANACHE_BAD_CLIP = 6,  /* A clip has bad numbers, or pairs are none to learn a style from. */
  PANACHE_BAD_STYLE = 7, /* The bytes are no style file, or none that goes with the model. */
  PANACHE_BAD_FILE = 8   /* The bytes are no motion file that this library reads. */
} panache_status;

/* What was wrong when a function of this thread last failed, in one line; "" if none has. Valid
 * until the next failure in the same thread. */
PANACHE_API const char* panache_last_error(void);

/* What kind of mistake that was, for programs that help with it. The text may change between
 * versions, the kind does not. */
typedef enum panache_error_kind {
  PANACHE_ERROR_OTHER = 0,
  PANACHE_ERROR_FILE_EXISTS = 1, /* A file would be overwritten. */
  PANACHE_ERROR_RATE_NEEDED = 2, /* A file has no frame rate, or one that cannot be. */
  PANACHE_ERROR_NOT_HUMANOID = 3, /* A skeleton in which no person was found. */
  /* A model has many styles, but not this one; the message names the nearest. */
  PANACHE_ERROR_UNKNOWN_STYLE = 4,
  PANACHE_ERROR_NO_STYLES = 5, /* A model has no styles yet. */
  PANACHE_ERROR_STYLE_EXISTS = 6, /* A model has a style of that name. */
  PANACHE_ERROR_IS_MODEL = 7, /* A model in the place of a style file. */
  PANACHE_ERROR_IS_STYLE_FILE = 8, /* A style file in the place of a model. */
  PANACHE_ERROR_STYLE_OF_ANOTHER = 9, /* A style file that was made with another model. */
  PANACHE_ERROR_NOT_SAFETENSORS = 10, /* Neither a model nor a style file. */
  PANACHE_ERROR_MODEL_CANNOT_LEARN = 11, /* A model without the statistics that learning needs. */
  PANACHE_ERROR_OTHER_SKELETONS = 12, /* A pair of clips whose skeletons differ. */
  PANACHE_ERROR_LOOP_OPEN = 13, /* A clip whose last pose is not its first. */
  PANACHE_ERROR_LOOP_STRENGTHS = 14, /* Strengths that differ at the ends of a loop. */
  PANACHE_ERROR_BAD_STYLE_NAME = 15 /* A style name of a manifest that people cannot type. */
} panache_error_kind;
PANACHE_API panache_error_kind panache_last_error_kind(void);

/* ---- Bytes ---------------------------------------------------------------------------------- */

/* The content of a file that the library made. */
typedef struct panache_bytes panache_bytes;

/* Valid as long as `bytes`. */
PANACHE_API const void* panache_bytes_data(const panache_bytes* bytes);
PANACHE_API size_t panache_bytes_size(const panache_bytes* bytes);
/* Does nothing with NULL. */
PANACHE_API void panache_bytes_destroy(panache_bytes* bytes);

/* ---- Models --------------------------------------------------------------------------------- */

/* A trained model: its styles and networks. Never changes. */
typedef struct panache_model panache_model;

/* Reads a model from the bytes of its file (.safetensors), which may go afterwards. */
PANACHE_API panache_status panache_model_create(const void* bytes, size_t size,
                                                panache_model** out);
/* Does nothing with NULL. */
PANACHE_API void panache_model_destroy(panache_model* model);

/* Number of styles; they are told apart by their places, from 0. */
PANACHE_API int32_t panache_model_style_count(const panache_model* model);
/* The name of a style ("old"), valid as long as the model; NULL where none is at that place. */
PANACHE_API const char* panache_model_style_name(const panache_model* model, int32_t style);
/* What a style is listed under ("moods"), valid as long as the model; "" for learnt styles and where
 * the model names no groups, NULL where no style is at that place. */
PANACHE_API const char* panache_model_style_group(const panache_model* model, int32_t style);
/* The place of the style of that name, or -1. The case of A to Z counts only where two styles have
 * the same letters. */
PANACHE_API int32_t panache_model_find_style(const panache_model* model, const char* name);

/* ---- Skeletons ------------------------------------------------------------------------------ */

/* A rig, and which of its joints are a humanoid's. Never changes. */
typedef struct panache_skeleton panache_skeleton;

/* One joint as the caller has it. */
typedef struct panache_joint {
  const char* name;     /* "LeftHand", "mixamorig:LeftHand", "hand_l", ...; may be "". */
  int32_t parent;       /* Place of the parent, smaller than the joint's own; -1 for a root. */
  float rotation[4];    /* At rest, relative to the parent. */
  float translation[3]; /* Likewise. */
} panache_joint;

/* Which joint of a skeleton is a joint of the humanoid. */
typedef struct panache_human_joint {
  const char* vrm_name; /* "leftHand", "hips", ...: the names of VRM 1.0. */
  int32_t joint;        /* Its place in the skeleton; -1: the rig has none. */
} panache_human_joint;

/* What may be told about a rig instead of having it found. Start with PANACHE_SKELETON_OPTIONS. */
typedef struct panache_skeleton_options {
  uint32_t struct_size;
  float metres_per_unit; /* 0: judged by the length of the legs. */
  const char* up_axis;   /* "+Y", "-Z", ...; NULL: found. */
  /* A few poses of the rig's ordinary motion; they tell the axes, the floor and the sides of joints
   * without names better than the rest pose alone, which stands in where there are none. */
  const float* rotations;    /* [pose_count][joint_count][4] */
  const float* translations; /* [pose_count][joint_count][3] */
  int32_t pose_count;
  /* The joint map, where names and shape are not enough: what is listed is taken as it is, all
   * other joints are found. */
  int32_t human_joint_count;
  const panache_human_joint* human_joints; /* [human_joint_count] */
} panache_skeleton_options;
#define PANACHE_SKELETON_OPTIONS \
  { sizeof(panache_skeleton_options), 0, NULL, NULL, NULL, 0, 0, NULL }

/* Finds the humanoid among the joints, by their names and their shape. `options` may be NULL. */
PANACHE_API panache_status panache_skeleton_create(const panache_joint* joints, int32_t joint_count,
                                                   const panache_skeleton_options* options,
                                                   panache_skeleton** out);
/* Does nothing with NULL. */
PANACHE_API void panache_skeleton_destroy(panache_skeleton* skeleton);

PANACHE_API int32_t panache_skeleton_joint_count(const panache_skeleton* skeleton);
/* The place of the joint that a VRM humanoid joint was found to be ("leftHand", "hips", ...), or -1
 * where the rig has none or there is no such name. */
PANACHE_API int32_t panache_skeleton_find(const panache_skeleton* skeleton, const char* vrm_name);

/* ---- Characters ----------------------------------------------------------------------------- */

/* One character in motion: its memory of the last quarter of a second. */
typedef struct panache_character panache_character;

/* How a character is styled. Start with PANACHE_CHARACTER_OPTIONS. */
typedef struct panache_character_options {
  uint32_t struct_size;
  float ease_seconds; /* A change of strength takes about this long; 0 to 10. */
  /* Time constant of the filter on what a style adds; 0 to 10. Calm motion that is unlike what was
   * captured is filtered up to eleven times as long. */
  float smoothing_seconds;
  int32_t hold_feet;  /* 1: planted feet are held; they creep slowly to a style's stance. */
  int32_t style_root; /* 1: root motion is styled too. */
  /* 1: skip or repeat whole cycles of a walk (or other repetitive motion) to stay within the
   * limits, so that the style's tempo lasts. Needs a max_lag longer than a cycle, say 1.5 seconds.
   * The character is then at another place than its input. */
  int32_t skip_cycles;
  /* A style's own tempo needs time: the maximum lag behind the input (0 to 4 seconds) and the
   * maximum lead (0 to 0.25; missing input is predicted, if the model can). With both at 0 no
   * latency is added, and the tempo stays the input's. */
  double max_lag, max_lead;
  /* Hips that move faster over the ground than this, in m/s, have jumped: the past is forgotten,
   * and the style starts afresh. A body on a vehicle or a moving platform, in world space, needs a
   * higher limit, or it is styled anew at each frame. 0 or INFINITY: no distance is a jump, and
   * panache_character_reset() tells of one. A sprinter reaches 12 m/s. */
  double max_speed;
} panache_character_options;
#define PANACHE_CHARACTER_OPTIONS \
  { sizeof(panache_character_options), 0.15f, 0.04f, 1, 1, 0, 0, 0, 15 }

/* `options` may be NULL. */
PANACHE_API panache_status panache_character_create(const panache_model* model,
                                                    const panache_skeleton* skeleton,
                                                    const panache_character_options* options,
                                                    panache_character** out);
/* Does nothing with NULL. */
PANACHE_API void panache_character_destroy(panache_character* character);

/* Sets how strongly a style acts from now on: 0 not at all, 1 as captured, more exaggerates; held
 * within -4 to 4, and eased over a few frames. Styles add up. A place without a style and numbers
 * that are not finite are ignored. */
PANACHE_API void panache_character_set_strength(panache_character* character, int32_t style,
                                                float strength);

/* How much is given of what the styles do, and where. 1 is the style as the model has it; each is
 * held within 0 to 2, and numbers that are not finite count as 1. Start with PANACHE_SHAPE. */
typedef struct panache_shape {
  uint32_t struct_size;
  float strength; /* Of all styles together. */
  float posture;  /* Of the lasting part of the change: its mean over the last second or so. */
  float dynamics; /* Of what the change is beyond that, and of the root motion. */
  float timing;   /* Of the change of tempo. */
  /* Parts of the body, each relative to what it is attached to. Legs include hips, height and root
   * motion; the torso includes the head. */
  float legs, torso, left_arm, right_arm;
  float foot_lock; /* How firmly planted feet are held, 0 to 1. */
} panache_shape;
#define PANACHE_SHAPE \
  { sizeof(panache_shape), 1, 1, 1, 1, 1, 1, 1, 1, 1 }

/* Sets the shape from now on; eased as strengths are. NULL: all of it at 1. */
PANACHE_API panache_status panache_character_set_shape(panache_character* character,
                                                       const panache_shape* shape);

/* An instant of a rig, to be read and to be written. */
typedef struct panache_input_pose {
  const float* rotations;    /* [joint_count][4] */
  const float* translations; /* [joint_count][3] */
} panache_input_pose;
typedef struct panache_output_pose {
  float* rotations;    /* [joint_count][4] */
  float* translations; /* [joint_count][3] */
} panache_output_pose;

/* Styles the next pose of a character; `seconds` have gone by since the last. Both poses may be the
 * same arrays. With all strengths at 0, `out` is `in` bit for bit (models of recipe panache).
 * Poses that are not finite are replaced by the last good one, and `seconds` below 0 or NaN count
 * as 0. After half a second without a step (infinite `seconds` included) or a jump (max_speed),
 * the past is forgotten. */
PANACHE_API void panache_character_step(panache_character* character, panache_input_pose in,
                                        double seconds, panache_output_pose out);
/* Does the same for many characters at once: in[i] becomes out[i], bit for bit as alone, in less
 * time where characters of one model stand side by side. A character that comes twice is stepped
 * twice. No out[i] may be part of another character's pose. Works in about 180 KB of the stack. */
PANACHE_API void panache_step_many(panache_character* const* characters, int32_t count,
                                   const panache_input_pose* in, double seconds,
                                   const panache_output_pose* out);
/* Forgets the motion so far; strengths stay. */
PANACHE_API void panache_character_reset(panache_character* character);

/* What went on at the last step. Start with PANACHE_REPORT. */
typedef struct panache_report {
  uint32_t struct_size;
  float gate;        /* 1: motion like what the model knows; 0: unlike, the style's mean is used. */
  float contacts[2]; /* Probability that the left and the right foot are planted. */
  double rate;       /* Seconds of input that the style would take per second: 0.5 to 2. */
  double ahead;      /* Seconds from the newest input to what is shown; below 0: it is late. */
} panache_report;
#define PANACHE_REPORT \
  { sizeof(panache_report), 0, {0, 0}, 0, 0 }

/* Fills the report as far as its struct_size goes. */
PANACHE_API panache_status panache_character_get_report(const panache_character* character,
                                                        panache_report* report);

/* A character's memory, to return to a moment (rollback, rewind): bytes for memory, not for files.
 * save() writes panache_character_state_size() bytes. restore() takes them into any character of
 * the same model, skeleton and options, which then goes on bit for bit; strengths as they were set
 * are not part of it. Characters with the same history since their creation or reset save the same
 * bytes. On failure the character is as before. */
PANACHE_API size_t panache_character_state_size(const panache_character* character);
PANACHE_API void panache_character_save(const panache_character* character, void* out);
PANACHE_API panache_status panache_character_restore(panache_character* character,
                                                     const void* bytes, size_t size);

/* ---- Clips ---------------------------------------------------------------------------------- */

/* Motion of a rig at a constant rate. */
typedef struct panache_clip {
  const panache_skeleton* skeleton;
  int32_t frame_count;
  double frame_seconds;      /* From one frame to the next. */
  const float* rotations;    /* [frame_count][joint_count][4] */
  const float* translations; /* [frame_count][joint_count][3] */
} panache_clip;

/* The strength of one style along a clip: straight lines between the keys, held before the first
 * and after the last. One key is a constant strength. */
typedef struct panache_strength_key {
  double seconds; /* Of the input; each key is later than the one before it. */
  float strength; /* As in panache_character_set_strength(). */
} panache_strength_key;
typedef struct panache_strength_track {
  int32_t style;
  int32_t key_count; /* At least 1. */
  const panache_strength_key* keys;
} panache_strength_track;

/* How a clip is styled. Start with PANACHE_STYLIZE_OPTIONS. */
typedef struct panache_stylize_options {
  uint32_t struct_size;
  /* As in panache_character_options. */
  float ease_seconds;
  float smoothing_seconds;
  int32_t hold_feet;
  int32_t style_root;
  int32_t style_timing; /* 1: where the feet step the clip gets the tempo of the style, so that
                         * talk and gestures keep their length; 2: everywhere; 0: frame by frame. */
  const panache_shape* shape; /* NULL: all of it at 1. */
  double max_speed;           /* As in panache_character_options. */
  int32_t loop; /* 1: a clip whose last pose is its first, travel aside, gets a result of which the
                 * same is true; 2: any clip does, or the call fails where the two are too far
                 * apart; 0: none does, as in programs of an older header. */
  int32_t reserved; /* 0. */
} panache_stylize_options;
#define PANACHE_STYLIZE_OPTIONS \
  { sizeof(panache_stylize_options), 0.15f, 0.04f, 1, 1, 1, NULL, 15, 1, 0 }

/* A clip that was styled. */
typedef struct panache_styled_clip panache_styled_clip;

/* Styles a whole clip, with the tempo of the style: the result may have more frames than the clip,
 * or fewer, at the same rate. Strengths of tracks of the same style add up. With all strengths at 0
 * the result is the clip bit for bit (models of recipe panache). `options` may be NULL. */
PANACHE_API panache_status panache_stylize_clip(
    const panache_model* model, const panache_clip* clip, const panache_strength_track* tracks,
    int32_t track_count, const panache_stylize_options* options, panache_styled_clip** out);
/* Does nothing with NULL. */
PANACHE_API void panache_styled_clip_destroy(panache_styled_clip* styled);

PANACHE_API int32_t panache_styled_clip_frame_count(const panache_styled_clip* styled);
/* What follows is valid as long as `styled`. */
/* [frame_count][joint_count][4] */
PANACHE_API const float* panache_styled_clip_rotations(const panache_styled_clip* styled);
/* [frame_count][joint_count][3] */
PANACHE_API const float* panache_styled_clip_translations(const panache_styled_clip* styled);
/* The frame of the input that each frame shows, with fractions. [frame_count] */
PANACHE_API const double* panache_styled_clip_source_frames(const panache_styled_clip* styled);
/* 1 where the left and the right foot are planted, else 0. [frame_count][2] */
PANACHE_API const uint8_t* panache_styled_clip_contacts(const panache_styled_clip* styled);
/* As panache_report.gate. [frame_count] */
PANACHE_API const float* panache_styled_clip_gates(const panache_styled_clip* styled);
/* 1 where the clip was styled as a loop, see panache_stylize_options.loop, else 0. */
PANACHE_API int32_t panache_styled_clip_is_loop(const panache_styled_clip* styled);

/* How a clip is put on another skeleton. Start with PANACHE_RETARGET_OPTIONS. */
typedef struct panache_retarget_options {
  uint32_t struct_size;
  int32_t hold_feet;  /* 1: feet on the floor, and planted where the motion plants them. */
  int32_t meet_hands; /* 1: hands that met meet again, as far as arms reach. */
} panache_retarget_options;
#define PANACHE_RETARGET_OPTIONS \
  { sizeof(panache_retarget_options), 1, 1 }

/* Puts a clip on another skeleton, in its rest pose, proportions, units and axes: directions of
 * limbs, hips by the length of the legs; fingers and twist joints where both have them. A
 * calibration pose in front of the clip is left out. The floor is where the toes of `onto` are at
 * rest. The result is read as a styled clip is, with the joints of `onto`; its gates are 1.
 * `options` may be NULL. */
PANACHE_API panache_status panache_retarget_clip(const panache_clip* clip,
                                                 const panache_skeleton* onto,
                                                 const panache_retarget_options* options,
                                                 panache_styled_clip** out);

/* ---- Learning a style -------------------------------------------------------------------------
 */

/* One action, done neutrally and in the style, by skeletons whose joints have the same names and
 * parents; rest poses and bone lengths may differ. 2 to 3 seconds of a walk, or the whole of a
 * gesture, are enough. Clips of one frame each are two poses: their difference is the style. */
typedef struct panache_pair {
  panache_clip neutral, styled;
} panache_pair;

/* A model that has learnt a style. */
typedef struct panache_learnt panache_learnt;

/* Learns the style `name` from pairs of clips, in about 0.3 s, on the features of the model
 * in these bytes. A style of this name is replaced where `replace` is 1, else it is an error. The
 * same input gives the same bytes. */
PANACHE_API panache_status panache_learn(const void* model_bytes, size_t model_size,
                                         const panache_pair* pairs, int32_t pair_count,
                                         const char* name, int32_t replace, panache_learnt** out);
/* Does nothing with NULL. */
PANACHE_API void panache_learnt_destroy(panache_learnt* learnt);

/* The bytes of the model with the style, valid as long as `learnt`: for panache_model_create() or a
 * file. All its other styles are as they were, bit for bit. */
PANACHE_API const void* panache_learnt_model(const panache_learnt* learnt, size_t* size);

/* How well it went. Start with PANACHE_LEARNT_REPORT. */
typedef struct panache_learnt_report {
  uint32_t struct_size;
  int32_t was_tested;   /* 0: the clips are too short to hold some back; the distances are 0. */
  const char* warnings; /* One sentence a line, "" if there are none; valid as long as `learnt`. */
  /* Mean distance of the joints on the last quarters of the styled clips, held back from a first
   * try, in centimetres on a body of 1.6 metres: of the style, of its mean posture alone, and of
   * the neutral motion as it is. */
  double held_back_cm, mean_posture_cm, untouched_cm;
} panache_learnt_report;
#define PANACHE_LEARNT_REPORT \
  { sizeof(panache_learnt_report), 0, NULL, 0, 0, 0 }

/* Fills the report as far as its struct_size goes. */
PANACHE_API panache_status panache_learnt_get_report(const panache_learnt* learnt,
                                                     panache_learnt_report* report);

/* By these distances "good"; "fair" where the style removes little of the distance, or its mean
 * posture alone more; "poor" where it is no better than the neutral motion, which is also one of
 * the warnings; "" where it was not tested. */
PANACHE_API const char* panache_learnt_verdict(const panache_learnt* learnt);

/* ---- Styles as files --------------------------------------------------------------------------
 */

/* A style file holds one style, which can be added to every model with the same networks. Each of
 * these makes new bytes and leaves what it is given as it is; all other styles of the model stay as
 * they are, bit for bit. */

/* The model with the style of a style file. A style of its name is replaced where `replace` is 1,
 * else it is an error. */
PANACHE_API panache_status panache_styles_add(const void* model_bytes, size_t model_size,
                                              const void* style_bytes, size_t style_size,
                                              int32_t replace, panache_bytes** out);
/* The model without a style. Its last style stays. */
PANACHE_API panache_status panache_styles_remove(const void* model_bytes, size_t model_size,
                                                 const char* name, panache_bytes** out);
/* The style file of a style of the model. */
PANACHE_API panache_status panache_styles_extract(const void* model_bytes, size_t model_size,
                                                  const char* name, panache_bytes** out);

/* ---- Motion files ---------------------------------------------------------------------------- */

/* BVH, GLB, glTF, VRM and VRMA files, as the program reads and writes them, and AMC files, which
 * are written as BVH. Not in the WebAssembly module. */

/* A motion file as a whole: its joints, its motions, and all else that stays when it is written
 * again. Never changes. */
typedef struct panache_motion_file panache_motion_file;

/* Reads a file from its bytes, which may go afterwards. The extension of `name` tells the format;
 * the name stands in front of messages, and a .gltf may have data, an .amc has its .asf, in files
 * beside it. */
PANACHE_API panache_status panache_motion_file_create(const void* bytes, size_t size,
                                                      const char* name, panache_motion_file** out);
/* The same for a file whose rate is wrong or missing: reads and writes it as if it had so many
 * frames a second (0.01 to 10000). In glTF the keys of all animations that move joints are moved.
 */
PANACHE_API panache_status panache_motion_file_create_at_rate(const void* bytes, size_t size,
                                                              const char* name,
                                                              double frames_per_second,
                                                              panache_motion_file** out);
/* Does nothing with NULL. */
PANACHE_API void panache_motion_file_destroy(panache_motion_file* file);

PANACHE_API int32_t panache_motion_file_joint_count(const panache_motion_file* file);
/* The joint at this place, 0 to joint_count - 1; its name is valid as long as the file. */
PANACHE_API void panache_motion_file_get_joint(const panache_motion_file* file, int32_t joint,
                                               panache_joint* out);
/* Number of motions; 0 where the file has a skeleton alone. */
PANACHE_API int32_t panache_motion_file_clip_count(const panache_motion_file* file);
/* The name of a motion, "" where it has none, valid as long as the file; NULL where there is no
 * motion at that place. */
PANACHE_API const char* panache_motion_file_clip_name(const panache_motion_file* file,
                                                      int32_t clip);
/* 1 where a motion moves a joint of the humanoid; 0 where it moves others alone, such as a prop, or
 * none, as animations of morph weights do: restyling it would make a motion of nothing. */
PANACHE_API int32_t panache_motion_file_clip_moves(const panache_motion_file* file, int32_t clip);
/* What is odd about the file although it was read, one sentence a line: a BVH file whose count of
 * frames is wrong or whose last row is cut, keys before 0 s, motions that move no joint of the
 * humanoid, steps far too fast or slow for the legs. Empty where there is nothing. */
PANACHE_API panache_status panache_motion_file_get_notes(const panache_motion_file* file,
                                                         panache_bytes** out);
/* A motion, or one frame at rest where `clip` is -1. Its arrays are valid as long as the file; its
 * skeleton is NULL, for the caller to set. */
PANACHE_API panache_status panache_motion_file_get_clip(const panache_motion_file* file,
                                                        int32_t clip, panache_clip* out);
/* The skeleton of a motion: the very one that the program finds, from all that the file says of its
 * joints. Where `clip` is -1, that of the character, to put motion on with panache_retarget_clip():
 * of the rest pose, where that stands on the floor, else of the first motion. Poses among the
 * options are not read: they are the file's. `options` may be NULL. */
PANACHE_API panache_status panache_motion_file_create_skeleton(
    const panache_motion_file* file, int32_t clip, const panache_skeleton_options* options,
    panache_skeleton** out);

/* New frames for a motion of a file, or a new motion. */
typedef struct panache_clip_edit {
  int32_t clip;        /* The motion whose frames these are; -1: a new one. */
  const char* name;    /* Of what results, where the format has names; may be NULL. */
  panache_clip frames; /* Of the file's joints, at least one; the skeleton is not read. Those of a
                          motion of the file have its frame_seconds. */
  /* The frame of the motion that each comes from, with fractions; NULL: frame by frame, as many as
   * the motion has. Not read of a new one. [frame_count] */
  const double* source_frames;
} panache_clip_edit;

/* What becomes of the file's own motions. A BVH or VRMA file holds one, which is always
 * replaced. */
typedef enum panache_edit_mode {
  PANACHE_REPLACE = 0,  /* The new frames replace the motion; a new motion replaces all. */
  PANACHE_ADD_LAST = 1, /* They are added after the file's own, */
  PANACHE_ADD_FIRST = 2 /* or before. */
} panache_edit_mode;

/* The bytes of the file with the edits in it. What they leave as it was keeps the very numbers of
 * the file. */
PANACHE_API panache_status panache_motion_file_write(const panache_motion_file* file,
                                                     const panache_clip_edit* edits,
                                                     int32_t edit_count, panache_edit_mode mode,
                                                     panache_bytes** out);

/* ---- Training samples --------------------------------------------------------------------------
 */

/* What the networks of recipe panache are trained on, for training of your own. */
typedef struct panache_samples panache_samples;

#define PANACHE_WINDOW_SIZE 396 /* 6 poses, newest first, of 66 features: docs/conventions.md. */
#define PANACHE_CHANGE_SIZE 67  /* 21 rotation vectors, height, velocities: as there. */

/* The samples of pairs of clips: a window of the neutral clip for each instant of the styled one,
 * at 30 a second, laid together as panache_learn() does it. A pair whose styled clip has no frames
 * gives a window of each instant of the neutral clip, and changes of 0. */
PANACHE_API panache_status panache_samples_create(const panache_pair* pairs, int32_t pair_count,
                                                  panache_samples** out);
/* Does nothing with NULL. */
PANACHE_API void panache_samples_destroy(panache_samples* samples);

PANACHE_API int32_t panache_samples_count(const panache_samples* samples);
/* What follows is valid as long as `samples`. */
/* In metres, metres and radians per second, body frame. [count][PANACHE_WINDOW_SIZE] */
PANACHE_API const float* panache_samples_windows(const panache_samples* samples);
/* What the style does there. [count][PANACHE_CHANGE_SIZE] */
PANACHE_API const float* panache_samples_changes(const panache_samples* samples);
/* Logarithm of neutral seconds per styled second. [count] */
PANACHE_API const float* panache_samples_log_rates(const panache_samples* samples);
/* 1 where the left and the right foot of the styled clip are planted, else 0. [count][2] */
PANACHE_API const float* panache_samples_contacts(const panache_samples* samples);

#ifdef __cplusplus
}
#endif
#endif /* PANACHE_PANACHE_H_ */

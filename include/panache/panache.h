/* Panache restyles the motion of a character in real time. This header is the whole interface.
 *
 *     panache_model *model = NULL;           (shared by all characters)
 *     panache_skeleton *skeleton = NULL;     (shared by all characters with the same rig)
 *     panache_character *character = NULL;   (one each)
 *     panache_model_create(bytes, size, &model);
 *     panache_skeleton_create(joints, joint_count, NULL, &skeleton);
 *     panache_character_create(model, skeleton, NULL, &character);
 *     panache_character_set_strength(character, panache_model_find_style(model, "old"), 1.0f);
 *     each frame: panache_character_step(character, in, 1.0 / 60, out);
 *
 * Conventions. A pose has a rotation (unit quaternion x, y, z, w) and a translation (three numbers)
 * for each joint, relative to its parent, in the units and axes of the skeleton. Units and up axis
 * are inferred or given. Joints are in the order of the skeleton, parents before children. Times
 * are in seconds, as double. Strings are UTF-8 and end with a zero.
 *
 * Errors. Functions that can fail return a panache_status and set panache_last_error(); on failure
 * the output pointer is set to NULL. All other functions cannot fail. Arguments must not be NULL
 * unless stated.
 *
 * Memory. The caller owns what a _create function returns and passes it to the matching _destroy
 * function, in any order: characters keep their model and skeleton alive. The library keeps no
 * pointer that is passed to it. Stepping does not allocate, lock or fail.
 *
 * Versions. Options, shapes and reports begin with struct_size: initialise them with the macro of
 * the same name. New fields are only added at the end, so programs keep running with newer
 * libraries (docs/c.md). A struct_size of 0, or unknown fields that are not 0, cause
 * PANACHE_BAD_ARGUMENT. All other structs never change.
 *
 * Threads. Any number of threads may use a model or skeleton at once; a character belongs to one
 * thread at a time. Equal inputs give the same bits on every instruction set.
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

/* The version of this header. Programs run with this or any newer library of the same major version
 * (of the same minor version while the major version is 0). */
#define PANACHE_VERSION_MAJOR 0
#define PANACHE_VERSION_MINOR 2
#define PANACHE_VERSION_PATCH 0

/* The library's own version: 10000 major + 100 minor + patch. */
PANACHE_API int32_t panache_version(void);

typedef enum panache_status {
  PANACHE_OK = 0,
  PANACHE_BAD_MODEL = 1,    /* The bytes are not a model that this library supports. */
  PANACHE_BAD_SKELETON = 2, /* The joints are not a skeleton, or not a humanoid. */
  PANACHE_BAD_ARGUMENT = 3, /* An option is out of its range. */
  PANACHE_BAD_STATE = 4,    /* The bytes are not a saved state of such a character. */
  PANACHE_NO_MEMORY = 5,
  PANACHE_BAD_CLIP = 6,  /* A clip has invalid numbers, or pairs are unsuitable. */
  PANACHE_BAD_STYLE = 7, /* The bytes are not a style file for this model. */
  PANACHE_BAD_FILE = 8   /* The bytes are not a motion file that this library reads. */
} panache_status;

/* The message of the last failure in this thread, in one line; "" if no function has failed. Valid
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

/* The content of a file, made by the library. */
typedef struct panache_bytes panache_bytes;

/* Valid as long as `bytes`. */
PANACHE_API const void* panache_bytes_data(const panache_bytes* bytes);
PANACHE_API size_t panache_bytes_size(const panache_bytes* bytes);
/* NULL is allowed. */
PANACHE_API void panache_bytes_destroy(panache_bytes* bytes);

/* ---- Models --------------------------------------------------------------------------------- */

/* A trained model: styles and networks. Immutable. */
typedef struct panache_model panache_model;

/* Reads a model from the bytes of its file (.safetensors); they may be freed when this returns. */
PANACHE_API panache_status panache_model_create(const void* bytes, size_t size,
                                                panache_model** out);
/* NULL is allowed. */
PANACHE_API void panache_model_destroy(panache_model* model);

/* Number of styles. A style is identified by its index, from 0. */
PANACHE_API int32_t panache_model_style_count(const panache_model* model);
/* The name of a style ("old"), valid as long as the model; NULL if the index is out of range. */
PANACHE_API const char* panache_model_style_name(const panache_model* model, int32_t style);

/* What a model says of a style, beside its name. Texts are "" where it says nothing, and valid as
 * long as the model. Initialise with PANACHE_STYLE_INFO. */
typedef struct panache_style_info {
  uint32_t struct_size;
  int32_t takes_off;       /* 1: the model is a remover, which takes the style off. */
  int32_t is_learnt;       /* 1: from clips, as by panache_learn(). */
  int32_t has_sides;       /* 0: panache_character_set_side() is ignored (recipe smith2019). */
  int32_t gesture_count;   /* Short movements that it is known by; most styles have none. */
  const char* description; /* What it looks like, for people. */
  const char* group;       /* What it is listed under ("moods"); learnt styles have none. */
  const char* words;       /* Other words for it, lower case, between spaces ("elderly aged"). */
  /* The side that was captured, as one sees it ("right leg", "to the left"). It has the word left
   * or right in it once; with the other one it says what is seen of the mirrored style. */
  const char* side;
  const char* thumbnail; /* Poses from the clip that a learnt style comes from, SVG in one line. */
} panache_style_info;
#define PANACHE_STYLE_INFO \
  { sizeof(panache_style_info), 0, 0, 0, 0, NULL, NULL, NULL, NULL, NULL }

/* Fills the first struct_size bytes of the info. Fails if the index is out of range. */
PANACHE_API panache_status panache_model_get_style_info(const panache_model* model, int32_t style,
                                                        panache_style_info* info);
/* The side of a style, for panache_character_set_side(), that a word names: "captured", "mirrored",
 * and, if the info has a side, "left" or "right". Fails with PANACHE_BAD_ARGUMENT for another word,
 * and if the model's styles have no sides. */
PANACHE_API panache_status panache_model_find_side(const panache_model* model, int32_t style,
                                                   const char* word, float* side);
/* What a gesture does and how long ("glances left, 1.2 s"), different for all of a style; valid as
 * long as the model. NULL if an index is out of range. */
PANACHE_API const char* panache_model_gesture_name(const panache_model* model, int32_t style,
                                                   int32_t gesture);
/* The index of the style with this name, or else the first that other words for it ("elderly" for
 * "old") describe; -1 if there is none, with a message in panache_last_error() that names the
 * nearest. Case (of A to Z) matters only if two names differ in nothing else. */
PANACHE_API int32_t panache_model_find_style(const panache_model* model, const char* name);

/* Persons: how people differ in all that they do, as a few numbers, one for each axis of the model
 * (most of what an axis changes is its name: "arm swing"). Real people are distributed like
 * independent standard normal numbers; 0 everywhere is their mean, which changes nothing. */

/* Number of axes; 0 if the model has no persons. */
PANACHE_API int32_t panache_model_person_axis_count(const panache_model* model);
/* The name of an axis, valid as long as the model; NULL if the index is out of range. */
PANACHE_API const char* panache_model_person_axis_name(const panache_model* model, int32_t axis);
/* The person of a seed: each seed is another one, the same on every machine. `count` is
 * panache_model_person_axis_count(). Fails if the model has no persons. */
PANACHE_API panache_status panache_model_draw_person(const panache_model* model, uint32_t seed,
                                                     float* numbers, int32_t count);
/* The seed of a word, such as a character's name; of "7" it is 7. */
PANACHE_API uint32_t panache_person_seed(const char* word);

/* ---- Skeletons ------------------------------------------------------------------------------ */

/* A rig, with the mapping of its joints to a humanoid. Immutable. */
typedef struct panache_skeleton panache_skeleton;

/* One joint of the caller's skeleton. */
typedef struct panache_joint {
  const char* name;     /* "LeftHand", "mixamorig:LeftHand", "hand_l", ...; may be "". */
  int32_t parent;       /* Index of the parent, below the joint's own; -1 for a root. */
  float rotation[4];    /* At rest, relative to the parent. */
  float translation[3]; /* At rest, relative to the parent. */
} panache_joint;

/* Maps one joint of the humanoid to a joint of the skeleton. */
typedef struct panache_human_joint {
  const char* vrm_name; /* "leftHand", "hips", ...: the names of VRM 1.0. */
  int32_t joint;        /* Its index in the skeleton; -1: the rig lacks this joint. */
} panache_human_joint;

/* Overrides for the automatic detection of a rig. Initialise with PANACHE_SKELETON_OPTIONS. */
typedef struct panache_skeleton_options {
  uint32_t struct_size;
  float metres_per_unit; /* 0: inferred from the length of the legs. */
  const char* up_axis;   /* "+Y", "-Z", ...; NULL: inferred. */
  /* A few poses of ordinary motion. They determine the axes, the floor, and left and right of
   * nameless joints better than the rest pose, which is used without them. */
  const float* rotations;    /* [pose_count][joint_count][4] */
  const float* translations; /* [pose_count][joint_count][3] */
  int32_t pose_count;
  /* The joint map, if names and shape are not enough. Joints that are not listed are found
   * automatically. */
  int32_t human_joint_count;
  const panache_human_joint* human_joints; /* [human_joint_count] */
} panache_skeleton_options;
#define PANACHE_SKELETON_OPTIONS \
  { sizeof(panache_skeleton_options), 0, NULL, NULL, NULL, 0, 0, NULL }

/* Finds the humanoid among the joints, by names and shape. `options` may be NULL. */
PANACHE_API panache_status panache_skeleton_create(const panache_joint* joints, int32_t joint_count,
                                                   const panache_skeleton_options* options,
                                                   panache_skeleton** out);
/* NULL is allowed. */
PANACHE_API void panache_skeleton_destroy(panache_skeleton* skeleton);

PANACHE_API int32_t panache_skeleton_joint_count(const panache_skeleton* skeleton);
/* The index of the joint that is mapped to a VRM humanoid joint ("leftHand", "hips", ...), or -1 if
 * the rig lacks this joint or the name is unknown. */
PANACHE_API int32_t panache_skeleton_find(const panache_skeleton* skeleton, const char* vrm_name);

/* ---- Characters ----------------------------------------------------------------------------- */

/* The state of one character, with the last quarter of a second of its motion. */
typedef struct panache_character panache_character;

/* How a character is styled. Initialise with PANACHE_CHARACTER_OPTIONS. */
typedef struct panache_character_options {
  uint32_t struct_size;
  float ease_seconds; /* Duration of a change of strength; 0 to 10. */
  /* Time constant of the filter on the style's change; 0 to 10. On calm, unfamiliar motion the
   * filter is up to eleven times as long. */
  float smoothing_seconds;
  int32_t hold_feet;  /* 1: hold planted feet; they creep slowly to the style's stance. */
  int32_t style_root; /* 1: style the root motion too. */
  /* 1: skip or repeat whole cycles of a walk (or other repetitive motion) to stay within the
   * limits, so that the style's tempo lasts. Needs a max_lag longer than a cycle, such as 1.5
   * seconds. The character's position then differs from its input's. */
  int32_t skip_cycles;
  /* Limits for a style's own tempo: the maximum lag behind the input (0 to 4 seconds) and the
   * maximum lead (0 to 0.25; missing input is predicted if the model has a predictor). With both at
   * 0 the tempo is the input's, without added latency. */
  double max_lag, max_lead;
  /* Hips faster than this over the ground, in m/s, count as a jump: the motion so far is forgotten
   * and the style starts again. Set a higher limit for bodies on vehicles or moving platforms in
   * world space. 0 or INFINITY: no limit; call panache_character_reset() after jumps. A sprinter
   * reaches 12 m/s. */
  double max_speed;
  /* A model that takes styles off, for panache_character_set_removed(); NULL: none. */
  const panache_model* remover;
  /* How often the active styles play their gestures, at random: 1 as often as the performers did, 0
   * not at all (as for older headers), up to 10 times as often. Characters with different seeds play
   * them at different times. */
  float gesture_rate;
  uint32_t gesture_seed;
} panache_character_options;
#define PANACHE_CHARACTER_OPTIONS \
  { sizeof(panache_character_options), 0.15f, 0.04f, 1, 1, 0, 0, 0, 15, NULL, 1, 0 }

/* `options` may be NULL. */
PANACHE_API panache_status panache_character_create(const panache_model* model,
                                                    const panache_skeleton* skeleton,
                                                    const panache_character_options* options,
                                                    panache_character** out);
/* NULL is allowed. */
PANACHE_API void panache_character_destroy(panache_character* character);

/* Sets the strength of a style: 0 off, 1 as captured, above 1 exaggerated; clamped to -4 to 4, and
 * eased in over ease_seconds. Styles add up. An index out of range and strengths that are not
 * finite are ignored. */
PANACHE_API void panache_character_set_strength(panache_character* character, int32_t style,
                                                float strength);

/* Sets the side of a style: 1 as captured, as at first; -1 its mirror image (a limp changes legs); 0
 * the mean of both. Clamped to -1 to 1, and eased in as strengths are. Between -1 and 1 a step costs
 * a second evaluation of the networks. An index out of range, sides that are not finite, and all
 * sides in models of recipe smith2019 are ignored. */
PANACHE_API void panache_character_set_side(panache_character* character, int32_t style,
                                            float side);

/* Makes the character the person of a seed, in addition to its styles, `amount` times as far from
 * the mean person: 0 nobody, as at first, 1 as real people differ, at most 2. Eased in as strengths
 * are. Fails if the model has no persons, or if the amount is not 0 to 2. */
PANACHE_API panache_status panache_character_set_person(panache_character* character, uint32_t seed,
                                                        float amount);
/* The same with the numbers of a person, clamped to -6 to 6. `count` is
 * panache_model_person_axis_count(). Fails if a number is not finite. */
PANACHE_API panache_status panache_character_set_person_numbers(panache_character* character,
                                                                const float* numbers,
                                                                int32_t count);
/* Writes the numbers that were set. */
PANACHE_API panache_status panache_character_get_person_numbers(const panache_character* character,
                                                                float* numbers, int32_t count);

/* Takes a style of the remover off the input, at the input's tempo, before the styles are put on:
 * its style "any" suits motion in an unknown style. -1: none, as at first. Eased in over
 * ease_seconds. Ignored without a remover, and for an index out of range. */
PANACHE_API void panache_character_set_removed(panache_character* character, int32_t style);

/* Plays a gesture of a style on top of it, as strongly as the style acts: when no other plays and a
 * foot is on the floor (and the body does not sit or run, if the gesture moves the hips), within 3
 * seconds or not at all. It never starts in the air. A later call replaces a gesture that waits.
 * Returns 1, or 0 if the model has no such gesture. */
PANACHE_API int32_t panache_character_trigger(panache_character* character, int32_t style,
                                              int32_t gesture);

/* How strongly each part of the styles is applied, and to which part of the body. 1 is the style of
 * the model; values are clamped to 0 to 2, and values that are not finite count as 1. Initialise
 * with PANACHE_SHAPE. */
typedef struct panache_shape {
  uint32_t struct_size;
  float strength; /* Multiplies all styles. */
  float posture;  /* The slow part of the change: its mean over about a second. */
  float dynamics; /* The rest of the change, and the root motion. */
  float timing;   /* The change of tempo. */
  /* Body regions, each relative to its parent. Legs include hips, height and root motion; the torso
   * includes the head. */
  float legs, torso, left_arm, right_arm;
  float foot_lock;     /* How firmly planted feet are held, 0 to 1. */
  float hand_contacts; /* How firmly hands keep what they touch, 0 to 1. */
  /* From calm (0) to lively (2): the input's own movement of torso, head and arms around its mean
   * over the last seconds. Acts without a style, too; feet and root motion keep theirs. */
  float energy;
} panache_shape;
#define PANACHE_SHAPE \
  { sizeof(panache_shape), 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1 }

/* Sets the shape; eased in as strengths are. NULL: 1 everywhere. */
PANACHE_API panache_status panache_character_set_shape(panache_character* character,
                                                       const panache_shape* shape);

/* A pose of a rig, to read and to write. */
typedef struct panache_input_pose {
  const float* rotations;    /* [joint_count][4] */
  const float* translations; /* [joint_count][3] */
} panache_input_pose;
typedef struct panache_output_pose {
  float* rotations;    /* [joint_count][4] */
  float* translations; /* [joint_count][3] */
} panache_output_pose;

/* Styles the next pose of a character, `seconds` after the last one. Both poses may share arrays.
 * With all strengths at 0, `out` equals `in`, bit for bit (models of recipe panache). Values that
 * are not finite are replaced by the last valid pose; negative `seconds` and NaN count as 0. After
 * half a second without a step (infinite `seconds` included) or a jump (max_speed), the motion so
 * far is forgotten. */
PANACHE_API void panache_character_step(panache_character* character, panache_input_pose in,
                                        double seconds, panache_output_pose out);
/* Styles the next poses of many characters: in[i] becomes out[i], with the same bits as alone.
 * Faster if characters of one model are adjacent. A character that is listed twice is stepped
 * twice. No out[i] may overlap another character's pose. Uses at most 200 KB of the stack. */
PANACHE_API void panache_step_many(panache_character* const* characters, int32_t count,
                                   const panache_input_pose* in, double seconds,
                                   const panache_output_pose* out);
/* Forgets the motion so far; keeps strengths and sides. */
PANACHE_API void panache_character_reset(panache_character* character);

/* Facts about the last step. Initialise with PANACHE_REPORT. */
typedef struct panache_report {
  uint32_t struct_size;
  float gate;        /* 1: familiar motion; 0: unfamiliar, only the style's mean is applied. */
  float contacts[2]; /* Probability that the left and the right foot are planted. */
  double rate;       /* The style's tempo: input seconds per output second, 0.5 to 2. */
  double ahead;      /* Lead of the output over the newest input, seconds; negative: lag. */
} panache_report;
#define PANACHE_REPORT \
  { sizeof(panache_report), 0, {0, 0}, 0, 0 }

/* Fills the first struct_size bytes of the report. */
PANACHE_API panache_status panache_character_get_report(const panache_character* character,
                                                        panache_report* report);

/* The state of a character, for rollback and rewind; valid in memory only, not in files. save()
 * writes panache_character_state_size() bytes. restore() reads them into any character with the
 * same model, skeleton and options, which then continues bit for bit; the strengths and sides that
 * were set are not part of the state. Characters with the same history since creation or reset save the same
 * bytes. On failure the character is unchanged. */
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

/* The strength of one style along a clip: linear between keys, constant before the first and after
 * the last. */
typedef struct panache_strength_key {
  double seconds; /* Of the input; increasing. */
  float strength; /* As in panache_character_set_strength(). */
} panache_strength_key;
typedef struct panache_strength_track {
  int32_t style;
  int32_t key_count; /* At least 1. */
  const panache_strength_key* keys;
} panache_strength_track;

/* How a clip is styled. Initialise with PANACHE_STYLIZE_OPTIONS. */
typedef struct panache_stylize_options {
  uint32_t struct_size;
  /* As in panache_character_options. */
  float ease_seconds;
  float smoothing_seconds;
  int32_t hold_feet;
  int32_t style_root;
  int32_t style_timing; /* The style's tempo. 0: off, frame by frame; 1: only where the feet step,
                         * so talk and gestures keep their length; 2: everywhere. */
  const panache_shape* shape; /* NULL: 1 everywhere. */
  double max_speed;           /* As in panache_character_options. */
  int32_t loop; /* 1: a clip that loops (its last pose equals its first, apart from travel) gives a
                 * result that loops; 2: every clip does, or the call fails if the two poses differ
                 * too much; 0: off, as for older headers. */
  int32_t removed; /* The style of the remover to take off first; 0 without one. */
  /* A model that takes styles off, also the tempo; NULL: none. */
  const panache_model* remover;
  /* As in panache_character_options. A result that loops has no gestures at random. */
  float gesture_rate;
  uint32_t gesture_seed;
  /* The side of each style of the model, as in panache_character_set_side(), -1 to 1; NULL: all 1.
   * [panache_model_style_count()] */
  const float* sides;
  /* The numbers of a person, as in panache_character_set_person_numbers(); NULL: nobody.
   * [panache_model_person_axis_count()] */
  const float* person;
} panache_stylize_options;
#define PANACHE_STYLIZE_OPTIONS \
  { sizeof(panache_stylize_options), 0.15f, 0.04f, 1, 1, 1, NULL, 15, 1, 0, NULL, 1, 0, NULL, NULL }

/* A styled clip. */
typedef struct panache_styled_clip panache_styled_clip;

/* Styles a whole clip. With the style's tempo the result may have more or fewer frames than the
 * clip, at the same rate. Tracks of the same style add up. With all strengths at 0 the result
 * equals the clip, bit for bit (models of recipe panache). `options` may be NULL. */
PANACHE_API panache_status panache_stylize_clip(
    const panache_model* model, const panache_clip* clip, const panache_strength_track* tracks,
    int32_t track_count, const panache_stylize_options* options, panache_styled_clip** out);
/* NULL is allowed. */
PANACHE_API void panache_styled_clip_destroy(panache_styled_clip* styled);

PANACHE_API int32_t panache_styled_clip_frame_count(const panache_styled_clip* styled);
/* These arrays are valid as long as `styled`. */
/* [frame_count][joint_count][4] */
PANACHE_API const float* panache_styled_clip_rotations(const panache_styled_clip* styled);
/* [frame_count][joint_count][3] */
PANACHE_API const float* panache_styled_clip_translations(const panache_styled_clip* styled);
/* The (fractional) frame of the input that each frame shows. [frame_count] */
PANACHE_API const double* panache_styled_clip_source_frames(const panache_styled_clip* styled);
/* 1 if the left or the right foot is planted, else 0. [frame_count][2] */
PANACHE_API const uint8_t* panache_styled_clip_contacts(const panache_styled_clip* styled);
/* As panache_report.gate. [frame_count] */
PANACHE_API const float* panache_styled_clip_gates(const panache_styled_clip* styled);
/* 1 if the result loops (panache_stylize_options.loop), else 0. */
PANACHE_API int32_t panache_styled_clip_is_loop(const panache_styled_clip* styled);

/* Which styles of a remover a clip shows: shares[i] for style i, and the last one for neutral;
 * together 1. `count` is panache_model_style_count(remover) + 1. */
PANACHE_API panache_status panache_recognise_styles(const panache_model* remover,
                                                    const panache_clip* clip, float* shares,
                                                    int32_t count);

/* How a clip is retargeted. Initialise with PANACHE_RETARGET_OPTIONS. */
typedef struct panache_retarget_options {
  uint32_t struct_size;
  int32_t hold_feet;  /* 1: feet stay above the floor, and planted feet stay planted. */
  int32_t meet_hands; /* 1: hands that touch still touch, as far as the arms reach. */
} panache_retarget_options;
#define PANACHE_RETARGET_OPTIONS \
  { sizeof(panache_retarget_options), 1, 1 }

/* Puts a clip on another skeleton with its own rest pose, proportions, units and axes. Limbs keep
 * their directions, hips are scaled by the length of the legs; fingers and twist joints move if
 * both skeletons have them. A leading calibration pose is dropped. The floor is at the toes of
 * `onto` at rest. The result has the joints of `onto`, and gates of 1. `options` may be NULL. */
PANACHE_API panache_status panache_retarget_clip(const panache_clip* clip,
                                                 const panache_skeleton* onto,
                                                 const panache_retarget_options* options,
                                                 panache_styled_clip** out);

/* ---- Learning a style ----------------------------------------------------------------------- */

/* One action, once neutral and once in the style. Joints have the same names and parents in both
 * skeletons; rest poses and bone lengths may differ. 2 to 3 seconds of a walk, or a whole gesture,
 * are enough. Clips of one frame each are two poses: their difference is the style. */
typedef struct panache_pair {
  panache_clip neutral, styled;
} panache_pair;

/* A model with a learnt style. */
typedef struct panache_learnt panache_learnt;

/* Learns the style `name` from pairs of clips, in about 0.3 s, and adds it to the model in these
 * bytes. An existing style of this name is replaced if `replace` is 1, otherwise it is an error.
 * The same input gives the same bytes. */
PANACHE_API panache_status panache_learn(const void* model_bytes, size_t model_size,
                                         const panache_pair* pairs, int32_t pair_count,
                                         const char* name, int32_t replace, panache_learnt** out);
/* As panache_learn(), from a clip in the style alone, of any action: how other people move takes
 * the place of the neutral clip. The bank is models/neutral.safetensors. The turn of a limb about
 * its own axis is not learnt. */
PANACHE_API panache_status panache_learn_alone(const void* model_bytes, size_t model_size,
                                               const void* bank_bytes, size_t bank_size,
                                               const panache_clip* styled, const char* name,
                                               int32_t replace, panache_learnt** out);
/* NULL is allowed. */
PANACHE_API void panache_learnt_destroy(panache_learnt* learnt);

/* The bytes of the model with the style, for panache_model_create() or a file; valid as long as
 * `learnt`. All other styles are unchanged, bit for bit. */
PANACHE_API const void* panache_learnt_model(const panache_learnt* learnt, size_t* size);

/* The quality of a learnt style. Initialise with PANACHE_LEARNT_REPORT. */
typedef struct panache_learnt_report {
  uint32_t struct_size;
  int32_t was_tested;   /* 0: the clips are too short for a test; the distances are 0. */
  const char* warnings; /* One per line, "" if there are none; valid as long as `learnt`. */
  /* Mean joint error on the last quarter of each styled clip, which is held back for this test, in
   * centimetres on a body of 1.6 metres: with the style, with its mean posture alone, and of the
   * neutral motion. */
  double held_back_cm, mean_posture_cm, untouched_cm;
  /* Of panache_learn_alone(), otherwise 0: the people whose mean takes the neutral clip's place,
   * whether their motion is like the clip's (if not, that is also a warning), and the share of the
   * difference in posture that counts as style; the rest is what people differ by, or unknown. */
  int32_t people, is_known;
  double certainty;
} panache_learnt_report;
#define PANACHE_LEARNT_REPORT \
  { sizeof(panache_learnt_report), 0, NULL, 0, 0, 0, 0, 0, 0 }

/* Fills the first struct_size bytes of the report. */
PANACHE_API panache_status panache_learnt_get_report(const panache_learnt* learnt,
                                                     panache_learnt_report* report);

/* By these distances "good"; "fair" if the style removes little of the distance, or less than its
 * mean posture alone; "poor" if it is no better than the neutral motion, which is also a warning;
 * "" if it was not tested. */
PANACHE_API const char* panache_learnt_verdict(const panache_learnt* learnt);

/* ---- Styles as files ------------------------------------------------------------------------ */

/* A style file holds one style, which can be added to any model with the same networks. These
 * functions return new bytes and do not change their inputs; all other styles of the model are
 * unchanged, bit for bit. */

/* Adds the style of a style file to a model. An existing style of its name is replaced if `replace`
 * is 1, otherwise it is an error. */
PANACHE_API panache_status panache_styles_add(const void* model_bytes, size_t model_size,
                                              const void* style_bytes, size_t style_size,
                                              int32_t replace, panache_bytes** out);
/* Removes a style from a model. The last style cannot be removed. */
PANACHE_API panache_status panache_styles_remove(const void* model_bytes, size_t model_size,
                                                 const char* name, panache_bytes** out);
/* Makes a style file from a style of the model. */
PANACHE_API panache_status panache_styles_extract(const void* model_bytes, size_t model_size,
                                                  const char* name, panache_bytes** out);

/* ---- Motion files ---------------------------------------------------------------------------- */

/* Reads and writes BVH, GLB, glTF, VRM, VRMA and FBX files as the program does (FBX not in the
 * WebAssembly module); AMC files are written as BVH. */

/* A whole motion file: joints, motions, and everything else that is kept when it is written again.
 * Immutable. */
typedef struct panache_motion_file panache_motion_file;

/* Reads a file from its bytes, which may be freed when this returns. The extension of `name`
 * decides the format, and messages begin with it. Further files are read beside it: the data of a
 * .gltf, the .asf of an .amc. */
PANACHE_API panache_status panache_motion_file_create(const void* bytes, size_t size,
                                                      const char* name, panache_motion_file** out);
/* The same for a file whose rate is wrong or missing: it is read and written at this rate (0.01 to
 * 10000). In glTF and FBX the keys of all animations that move joints are rescaled. */
PANACHE_API panache_status panache_motion_file_create_at_rate(const void* bytes, size_t size,
                                                              const char* name,
                                                              double frames_per_second,
                                                              panache_motion_file** out);
/* NULL is allowed. */
PANACHE_API void panache_motion_file_destroy(panache_motion_file* file);

PANACHE_API int32_t panache_motion_file_joint_count(const panache_motion_file* file);
/* The joint at this index, 0 to joint_count - 1; its name is valid as long as the file. */
PANACHE_API void panache_motion_file_get_joint(const panache_motion_file* file, int32_t joint,
                                               panache_joint* out);
/* Number of motions; 0 if the file has only a skeleton. */
PANACHE_API int32_t panache_motion_file_clip_count(const panache_motion_file* file);
/* The name of a motion, "" if it is nameless, valid as long as the file; NULL if the index is out
 * of range. */
PANACHE_API const char* panache_motion_file_clip_name(const panache_motion_file* file,
                                                      int32_t clip);
/* 1 if a motion moves a joint of the humanoid; 0 if it only moves other joints, such as a prop, or
 * morph weights, and so has nothing to restyle. */
PANACHE_API int32_t panache_motion_file_clip_moves(const panache_motion_file* file, int32_t clip);
/* Warnings about the file, one per line, or empty: a wrong frame count or cut last row in a BVH
 * file, keys before 0 s, motions that do not move the humanoid, steps far too fast or slow for the
 * legs. */
PANACHE_API panache_status panache_motion_file_get_notes(const panache_motion_file* file,
                                                         panache_bytes** out);
/* A motion, or one frame of the rest pose if `clip` is -1. Its arrays are valid as long as the
 * file; its skeleton is NULL and must be set by the caller. */
PANACHE_API panache_status panache_motion_file_get_clip(const panache_motion_file* file,
                                                        int32_t clip, panache_clip* out);
/* The skeleton of a motion, as the program finds it from the whole file. If `clip` is -1, that of
 * the character, as a target of panache_retarget_clip(): from the rest pose if it stands on the
 * floor, otherwise from the first motion. Poses in the options are ignored: the file's are used.
 * `options` may be NULL. */
PANACHE_API panache_status panache_motion_file_create_skeleton(
    const panache_motion_file* file, int32_t clip, const panache_skeleton_options* options,
    panache_skeleton** out);

/* New frames for a motion of a file, or a new motion. */
typedef struct panache_clip_edit {
  int32_t clip;        /* The motion to replace the frames of; -1: a new motion. */
  const char* name;    /* Of the result, if the format has names; may be NULL. */
  panache_clip frames; /* At least one, with the file's joints; the skeleton is ignored. Frames of
                          an existing motion have its frame_seconds. */
  /* The (fractional) frame of the motion that each frame shows; NULL: frame by frame, as many as
   * the motion has. Ignored for a new motion. [frame_count] */
  const double* source_frames;
} panache_clip_edit;

/* What happens to the file's own motions. A BVH or VRMA file holds one motion, which is always
 * replaced. */
typedef enum panache_edit_mode {
  PANACHE_REPLACE = 0,  /* The new frames replace the motion; a new motion replaces all. */
  PANACHE_ADD_LAST = 1, /* New frames are added after the file's own motions, */
  PANACHE_ADD_FIRST = 2 /* or before. */
} panache_edit_mode;

/* The bytes of the file with these edits. Everything else keeps the file's exact numbers. */
PANACHE_API panache_status panache_motion_file_write(const panache_motion_file* file,
                                                     const panache_clip_edit* edits,
                                                     int32_t edit_count, panache_edit_mode mode,
                                                     panache_bytes** out);

/* ---- Training samples ----------------------------------------------------------------------- */

/* Training data for the networks of recipe panache, for training of your own. Not in the WebAssembly
 * module. */
typedef struct panache_samples panache_samples;

#define PANACHE_WINDOW_SIZE 396 /* 6 poses, newest first, of 66 features: docs/conventions.md. */
#define PANACHE_CHANGE_SIZE 67  /* 21 rotation vectors, height, velocities: as there. */

/* The samples of pairs of clips: for each instant of the styled clip, at 30 a second, a window of
 * the neutral clip, aligned as in panache_learn(). A pair whose styled clip has no frames gives a
 * window for each instant of the neutral clip, and changes of 0. */
PANACHE_API panache_status panache_samples_create(const panache_pair* pairs, int32_t pair_count,
                                                  panache_samples** out);
/* NULL is allowed. */
PANACHE_API void panache_samples_destroy(panache_samples* samples);

PANACHE_API int32_t panache_samples_count(const panache_samples* samples);
/* These arrays are valid as long as `samples`. */
/* In metres, metres and radians per second, body frame. [count][PANACHE_WINDOW_SIZE] */
PANACHE_API const float* panache_samples_windows(const panache_samples* samples);
/* The style's change. [count][PANACHE_CHANGE_SIZE] */
PANACHE_API const float* panache_samples_changes(const panache_samples* samples);
/* Logarithm of neutral seconds per styled second. [count] */
PANACHE_API const float* panache_samples_log_rates(const panache_samples* samples);
/* 1 if the left or the right foot of the styled clip is planted, else 0. [count][2] */
PANACHE_API const float* panache_samples_contacts(const panache_samples* samples);

#ifdef __cplusplus
}
#endif
#endif /* PANACHE_PANACHE_H_ */

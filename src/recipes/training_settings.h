#pragma once
// How the networks of a recipe are trained.

#include <cstdint>

namespace panache {

// Disturbances of a window in training, so that the networks work on unseen bodies and captures.
// Each is a standard deviation; all but the jitter and the per-pose ones are the same for the six
// poses of a window.
struct Disturbance {
  float scale = 0;      // Relative, of the body size.
  float floor = 0;      // Height of the floor, metres.
  float heading = 0;    // Radians.
  float posture = 0;    // Constant offset of each feature, in deviations.
  float jitter = 0;     // Per pose and joint, metres.
  float velocity = 0;   // Per pose, m/s.
  float turn_rate = 0;  // Per pose, rad/s.
  float tempo = 0;      // Logarithm of the playback speed.
  // Other people's postures and movements: constant rotations of the joints about each axis of the
  // body frame, radians, and the fraction by which all movement is wider or narrower.
  float torso = 0, head = 0, arms = 0, legs = 0;
  float amplitude = 0;
};

// Disturbances that stand for other people, captures and files.
inline constexpr Disturbance kUsualDisturbance = {.scale = 0.08f,
                                                  .floor = 0.015f,
                                                  .heading = 0.12f,
                                                  .posture = 0.25f,
                                                  .jitter = 0.005f,
                                                  .velocity = 0.03f,
                                                  .turn_rate = 0.27f,
                                                  .tempo = 0.1f};

// What a style learnt from one person must tolerate: the usual, and other people. Tuned on walks of
// four performers with the style of a fifth.
inline constexpr Disturbance kOtherPeople = [] {
  Disturbance out = kUsualDisturbance;
  out.torso = out.legs = 0.09f;
  out.head = 0.14f;
  out.arms = 0.21f;
  out.amplitude = 0.3f;
  return out;
}();

// The same at any tempo, from half of the usual to twice as fast: the tempo of a style is learnt as
// that of its real takes, not as a ratio to one performer's neutral walk.
inline constexpr Disturbance kOtherTempos = [] {
  Disturbance out = kUsualDisturbance;
  out.tempo = 0.25f;
  return out;
}();

struct BatchSettings {
  int size = 256;
  // Rows grouped by style and in pairs of neighbouring frames, drawn by the square root of each
  // action's share in each style; otherwise single rows from all. Style heads need it.
  bool by_style = false;
  bool mirrored = false;   // Half of the rows are mirrored.
  bool disturbed = false;  // Layout positions only.
  Disturbance disturbance = kUsualDisturbance;
  float input_clip = 0;  // Normalised inputs are clamped to this many deviations; 0: not.
};

struct OptimizerSettings {
  float learning_rate = 0.01f;
  float epsilon = 1e-8f;   // Added to the root of the mean square in Adam.
  bool one_cycle = false;  // Rises to the learning rate, then falls to 0 (Smith 2018).
  float weight_decay = 0;  // Decoupled (AdamW, Loshchilov and Hutter 2019); not for biases.
  float dropout = 0;       // Fraction of hidden units dropped.
};

// How the pose network is trained on motion without styles, under a style classifier: see
// lab/train/guidance.h.
struct GuidanceSettings {
  int sequences = 0;         // Drawn at each guided step, each in one style; 0: no guidance.
  int every = 2;             // One of this many steps is guided; it takes as long as two others.
  int guides = 4;            // Networks of the guide,
  int guide_steps = 2500;    // and steps of training each.
  float weight = 1.4f;       // Weight of the sum of the penalties below, besides the pairs' loss.
  float style = 0.22f;       // The guides' cross entropy for the requested style,
  float statistics = 0.15f;  // and a discriminant of statistics that rejects it.
  float velocity = 0.7f;     // Hands and feet that move differently or less than the input's.
  float smoothness = 1.2f;   // Change from one instant to the next.
  float balance = 1;         // Leaving the feet's support, or sinking through the floor.
  float prior = 0.05f;       // Changes that never occur in the pairs.
  float signature = 0.3f;    // Posture and speed that change unlike in real takes.
  float anatomy = 0.1f;      // Joints that leave their range of motion.
  float standing = 0.12f;    // Movement of planted feet.
  float tempo = 0.1f;        // A tempo unlike that of real takes, besides the timing's own loss.
  float ramp = 0.2f;         // Fraction of the training until it has its full weight.
  float spliced = 0.6f;      // Fraction of the sequences with arms or upper body of another take.
  // Other people, two thirds as far from those of the takes as in kOtherPeople.
  Disturbance disturbance = {.scale = 0.06f,
                             .floor = 0.01f,
                             .posture = 0.15f,
                             .torso = 0.06f,
                             .head = 0.1f,
                             .arms = 0.14f,
                             .legs = 0.06f,
                             .amplitude = 0.2f};
};

// How the pose heads are fitted in closed form once the trunk is trained: lab/train/fit_heads.h.
struct HeadSettings {
  int64_t rank = 0;      // Combinations of activations that a head reads; 0: heads are not fitted.
  double penalty = 0.5;  // Of a squared weight, in variances of a standardised activation.
  int max_samples = 1500;  // Of a style, evenly spread,
  int copies = 4;          // each once as it is and in so many disturbed copies.
  int sequences = 200;     // Of motion without styles, one second each,
  double guided = 0.5;     // and its weight beside the style's own windows,
  double alike = 2;        // where it is further from them than so many times their own extent.
  double gain = 0.5;      // Share of the lost variation that is made up for in torso, arms and bob,
  double max_gain = 1.5;  // at most so much.
};

struct TrainingSettings {
  int64_t steps = 0;
  bool neutral_samples = false;  // Neutral takes are samples too, with themselves as the target.
  BatchSettings batch = {};
  OptimizerSettings optimizer = {};
  // The loss of the tempo is the squared error of its logarithm, not Poisson's loss.
  bool squared_tempo = false;
  float smoothness = 0;            // Weight of the loss on frame-to-frame change,
  float positions = 0;             // and of the loss on joint positions: PositionLoss.
  GuidanceSettings guidance = {};  // If there is motion without styles.
  HeadSettings heads = {};
  int64_t predictor_steps = 0;  // Training steps of the input predictor; 0: the model has none.
};

}  // namespace panache

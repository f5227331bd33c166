#pragma once
// How the networks of a recipe are trained.

#include <cstdint>

namespace panache {

// How a window is disturbed in training, so that the networks hold on bodies and captures they
// never saw. Each a standard deviation; all but the jitter and what is per pose are the same for
// the six poses of a window.
struct Disturbance {
  float scale = 0;      // Of body size.
  float floor = 0;      // Height of the floor, metres.
  float heading = 0;    // Radians.
  float posture = 0;    // Constant offset of each number, in deviations.
  float jitter = 0;     // Per pose and joint, metres.
  float velocity = 0;   // Per pose, m/s.
  float turn_rate = 0;  // Per pose, rad/s.
  float tempo = 0;      // Logarithm of how fast the window is played.
  // Other people hold and move themselves otherwise: constant turns of the joints about each axis
  // of the body frame, radians, and the share by which all movement is wider or narrower.
  float torso = 0, head = 0, arms = 0, legs = 0;
  float amplitude = 0;
};

// Disturbances of a window by other people, captures and files.
inline constexpr Disturbance kUsualDisturbance = {.scale = 0.08f,
                                                  .floor = 0.015f,
                                                  .heading = 0.12f,
                                                  .posture = 0.25f,
                                                  .jitter = 0.005f,
                                                  .velocity = 0.03f,
                                                  .turn_rate = 0.27f,
                                                  .tempo = 0.1f};

// What a style learnt from one person must hold on: the usual, and other people. Found on walks of
// four performers that a style of a fifth was put on.
inline constexpr Disturbance kOtherPeople = [] {
  Disturbance how = kUsualDisturbance;
  how.torso = how.legs = 0.09f;
  how.head = 0.14f;
  how.arms = 0.21f;
  how.amplitude = 0.3f;
  return how;
}();

struct BatchSettings {
  int size = 256;
  // Rows grouped by style and in pairs of neighbouring frames, drawn by the square root of the
  // share that each action in each style has; else one by one from all. Style heads need it.
  bool by_style = false;
  bool mirrored = false;   // Half of the rows left for right.
  bool disturbed = false;  // Layout positions only.
  Disturbance disturbance = kUsualDisturbance;
  float input_clip = 0;  // Normalised inputs are held within this many deviations; 0: not.
};

struct OptimizerSettings {
  float learning_rate = 0.01f;
  float epsilon = 1e-8f;   // Added to the root of the mean square in Adam.
  bool one_cycle = false;  // Rises to the learning rate, then falls to nothing (Smith 2018).
  float weight_decay = 0;  // Decoupled (AdamW, Loshchilov and Hutter 2019); biases have none.
  float dropout = 0;       // Share of hidden units left out.
};

// How the pose network is trained on motion without styles, under a style classifier: see
// lab/train/guidance.h.
struct GuidanceSettings {
  int sequences = 0;         // Drawn at each guided step, each in one style; 0: no guidance.
  int every = 2;             // Of so many steps one is guided: it takes as long as two others.
  int guides = 4;            // Networks of the guide,
  int guide_steps = 2500;    // and steps of training each.
  float weight = 1.4f;       // Of the sum of the following, beside the loss of the pairs.
  float style = 0.22f;       // Weight of the guides' cross entropy for the requested style,
  float statistics = 0.15f;  // and of not being so by a discriminant of statistics.
  float velocity = 0.7f;     // Of hands and feet that move otherwise or less than the input's.
  float smoothness = 1.2f;   // Of the change from one instant to the next.
  float balance = 1;         // Of leaving the feet's support, or sinking through the floor.
  float prior = 0.05f;       // Of changes that the pairs never show.
  float signature = 0.3f;    // Of posture and speed that change otherwise than in real takes.
  float anatomy = 0.1f;      // Of joints that leave their range of motion.
  float standing = 0.12f;    // Of moving feet that stand.
  float tempo = 0.1f;        // Of a tempo unlike that of real takes, beside the timing's own loss.
  float ramp = 0.2f;         // Share of the training until all of it counts in full.
  float spliced = 0.6f;      // Share of the sequences with arms or upper body of another take.
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

struct TrainingSettings {
  int64_t steps = 0;
  bool neutral_samples = false;  // Neutral takes are shown too, with themselves as the target.
  BatchSettings batch = {};
  OptimizerSettings optimizer = {};
  // The tempo is taught by the squared error of its logarithm, not by Poisson's loss.
  bool squared_tempo = false;
  float smoothness = 0;            // Weight of the loss on the change from one frame to the next,
  float positions = 0;             // and of that on where changes put the joints: PositionLoss.
  GuidanceSettings guidance = {};  // Where there is motion without styles.
  int64_t predictor_steps = 0;     // Of the network that predicts input; 0: the model has none.
};

}  // namespace panache

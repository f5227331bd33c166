#pragma once
// How the networks of a recipe are trained.

#include <cstdint>

namespace panache {

// How a window is disturbed in training, so that the networks hold on bodies and captures they
// never saw. Each a standard deviation; all but the jitter are the same for the six poses of a
// window.
struct Disturbance {
  float scale = 0.08f;      // Of body size.
  float floor = 0.015f;     // Height of the floor, metres.
  float heading = 0.12f;    // Radians.
  float posture = 0.25f;    // Constant offset of each number, in deviations.
  float jitter = 0.005f;    // Per pose and joint, metres.
  float velocity = 0.03f;   // Per pose, m/s.
  float turn_rate = 0.27f;  // Per pose, rad/s.
  float tempo = 0.1f;       // Logarithm of how fast the window is played.
};

struct BatchSettings {
  int size = 256;
  // Rows grouped by style and in pairs of neighbouring frames, drawn by the square root of the
  // share that each action in each style has; else one by one from all. Style heads need it.
  bool by_style = false;
  bool mirrored = false;   // Half of the rows left for right.
  bool disturbed = false;  // Layout positions only.
  Disturbance disturbance = {};
  float input_clip = 0;  // Normalised inputs are held within this many deviations; 0: not.
};

struct OptimizerSettings {
  float learning_rate = 0.01f;
  float epsilon = 1e-8f;   // Added to the root of the mean square in Adam.
  bool one_cycle = false;  // Rises to the learning rate, then falls to nothing (Smith 2018).
  float weight_decay = 0;  // Decoupled (AdamW, Loshchilov and Hutter 2019); biases have none.
  float dropout = 0;       // Share of hidden units left out.
};

struct TrainingSettings {
  int64_t steps = 0;
  bool neutral_samples = false;  // Neutral takes are shown too, with themselves as the target.
  BatchSettings batch = {};
  OptimizerSettings optimizer = {};
  float smoothness = 0;         // Weight of the loss on the change from one frame to the next.
  int64_t predictor_steps = 0;  // Of the network that predicts input; 0: the model has none.
};

}  // namespace panache

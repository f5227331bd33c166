/* A character for the samples: a skeleton of nineteen joints that walks, without any file. Stands
 * in for what an engine has: rest transforms once, and local transforms every frame. C99 and C++.
 */
#ifndef PANACHE_SAMPLES_STICK_FIGURE_H_
#define PANACHE_SAMPLES_STICK_FIGURE_H_

#include <math.h>
#include <panache/panache.h>
#include <stdio.h>
#include <stdlib.h>

#define STICK_JOINTS 19

/* Metres, Y up, facing +z, arms hanging. */
static const panache_joint stick_figure[STICK_JOINTS] = {
    {"Hips", -1, {0, 0, 0, 1}, {0, 0.95f, 0}},
    {"Spine", 0, {0, 0, 0, 1}, {0, 0.15f, 0}},
    {"Chest", 1, {0, 0, 0, 1}, {0, 0.15f, 0}},
    {"Neck", 2, {0, 0, 0, 1}, {0, 0.22f, 0}},
    {"Head", 3, {0, 0, 0, 1}, {0, 0.1f, 0.02f}},
    {"LeftUpperArm", 2, {0, 0, 0, 1}, {0.19f, 0.16f, 0}},
    {"LeftLowerArm", 5, {0, 0, 0, 1}, {0.02f, -0.28f, 0}},
    {"LeftHand", 6, {0, 0, 0, 1}, {0, -0.25f, 0.02f}},
    {"RightUpperArm", 2, {0, 0, 0, 1}, {-0.19f, 0.16f, 0}},
    {"RightLowerArm", 8, {0, 0, 0, 1}, {-0.02f, -0.28f, 0}},
    {"RightHand", 9, {0, 0, 0, 1}, {0, -0.25f, 0.02f}},
    {"LeftUpperLeg", 0, {0, 0, 0, 1}, {0.09f, -0.04f, 0}},
    {"LeftLowerLeg", 11, {0, 0, 0, 1}, {0, -0.42f, 0}},
    {"LeftFoot", 12, {0, 0, 0, 1}, {0, -0.41f, -0.02f}},
    {"LeftToes", 13, {0, 0, 0, 1}, {0, -0.07f, 0.14f}},
    {"RightUpperLeg", 0, {0, 0, 0, 1}, {-0.09f, -0.04f, 0}},
    {"RightLowerLeg", 15, {0, 0, 0, 1}, {0, -0.42f, 0}},
    {"RightFoot", 16, {0, 0, 0, 1}, {0, -0.41f, -0.02f}},
    {"RightToes", 17, {0, 0, 0, 1}, {0, -0.07f, 0.14f}},
};

typedef struct stick_pose {
  float rotations[STICK_JOINTS][4];
  float translations[STICK_JOINTS][3];
} stick_pose;

static inline panache_input_pose stick_input(const stick_pose* pose) {
  panache_input_pose view = {&pose->rotations[0][0], &pose->translations[0][0]};
  return view;
}
static inline panache_output_pose stick_output(stick_pose* pose) {
  panache_output_pose view = {&pose->rotations[0][0], &pose->translations[0][0]};
  return view;
}

/* Turns a joint about its x axis: arms and legs swing forward with angles below zero. */
static inline void stick_bend(stick_pose* pose, int joint, double angle) {
  pose->rotations[joint][0] = (float)sin(angle / 2);
  pose->rotations[joint][3] = (float)cos(angle / 2);
}

/* The figure as it walks, `seconds` after it began; `phase` in 0..1 sets it off from others. */
static inline void stick_walk(double seconds, double phase, stick_pose* pose) {
  const double turn = 6.283185307179586 * (seconds * 0.9 + phase);
  for (int j = 0; j < STICK_JOINTS; ++j) {
    for (int k = 0; k < 4; ++k) pose->rotations[j][k] = stick_figure[j].rotation[k];
    for (int k = 0; k < 3; ++k) pose->translations[j][k] = stick_figure[j].translation[k];
  }
  pose->translations[0][1] += (float)(0.02 * cos(2 * turn));
  pose->translations[0][2] += (float)(1.2 * seconds);
  stick_bend(pose, 5, 0.4 * sin(turn));
  stick_bend(pose, 8, -0.4 * sin(turn));
  stick_bend(pose, 6, -0.3);
  stick_bend(pose, 9, -0.3);
  stick_bend(pose, 11, -0.45 * sin(turn));
  stick_bend(pose, 15, 0.45 * sin(turn));
  stick_bend(pose, 12, 0.35 + 0.35 * cos(turn));
  stick_bend(pose, 16, 0.35 - 0.35 * cos(turn));
}

/* Reads a model, or says why not and ends the program. */
static inline panache_model* stick_load_model(const char* path) {
  FILE* file = fopen(path, "rb");
  panache_model* model = NULL;
  char* bytes = NULL;
  long size = -1;
  if (file && fseek(file, 0, SEEK_END) == 0) size = ftell(file);
  if (size > 0) bytes = (char*)malloc((size_t)size);
  if (bytes) {
    rewind(file);
    if (fread(bytes, 1, (size_t)size, file) == (size_t)size) {
      panache_model_create(bytes, (size_t)size, &model);
    }
  }
  free(bytes);
  if (file) fclose(file);
  if (!model) {
    fprintf(stderr, "%s: %s\n", path, size > 0 ? panache_last_error() : "cannot be read");
    exit(1);
  }
  return model;
}

/* Turns a vector by a unit quaternion. */
static inline void stick_rotate(const float q[4], const float v[3], float out[3]) {
  const float t[3] = {2 * (q[1] * v[2] - q[2] * v[1]), 2 * (q[2] * v[0] - q[0] * v[2]),
                      2 * (q[0] * v[1] - q[1] * v[0])};
  out[0] = v[0] + q[3] * t[0] + q[1] * t[2] - q[2] * t[1];
  out[1] = v[1] + q[3] * t[1] + q[2] * t[0] - q[0] * t[2];
  out[2] = v[2] + q[3] * t[2] + q[0] * t[1] - q[1] * t[0];
}

/* Where a joint is in the world. */
static inline void stick_position(const stick_pose* pose, int joint, float out[3]) {
  for (int k = 0; k < 3; ++k) out[k] = pose->translations[joint][k];
  for (int j = stick_figure[joint].parent; j >= 0; j = stick_figure[j].parent) {
    float turned[3];
    stick_rotate(pose->rotations[j], out, turned);
    for (int k = 0; k < 3; ++k) out[k] = turned[k] + pose->translations[j][k];
  }
}

#endif /* PANACHE_SAMPLES_STICK_FIGURE_H_ */

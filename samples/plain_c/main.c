/* The same in C99: a character grows proud, is rewound by half a second, and goes on alike. */

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../common/stick_figure.h"

int main(int argc, char** argv) {
  panache_skeleton* skeleton = NULL;
  panache_character* character = NULL;
  panache_model* model;
  stick_pose in, out, again;
  void* state;
  int style, frame;
  if (argc != 2) {
    fprintf(stderr, "usage: plain_c MODEL\n");
    return 2;
  }
  model = stick_load_model(argv[1]);
  if (panache_skeleton_create(stick_figure, STICK_JOINTS, NULL, &skeleton) ||
      panache_character_create(model, skeleton, NULL, &character)) {
    fprintf(stderr, "%s\n", panache_last_error());
    return 1;
  }
  for (style = 0; style < panache_model_style_count(model); ++style) {
    printf("%s%s", style ? ", " : "styles: ", panache_model_style_name(model, style));
  }
  printf("\n");

  panache_character_set_strength(character, panache_model_find_style(model, "proud"), 1);
  for (frame = 0; frame < 60; ++frame) {
    stick_walk(frame / 60.0, 0, &in);
    panache_character_step(character, stick_input(&in), 1 / 60.0, stick_output(&out));
  }
  state = malloc(panache_character_state_size(character));
  if (!state) return 1;
  panache_character_save(character, state);
  for (; frame < 90; ++frame) {
    stick_walk(frame / 60.0, 0, &in);
    panache_character_step(character, stick_input(&in), 1 / 60.0, stick_output(&out));
  }
  if (panache_character_restore(character, state, panache_character_state_size(character))) {
    fprintf(stderr, "%s\n", panache_last_error());
    return 1;
  }
  for (frame = 60; frame < 90; ++frame) {
    stick_walk(frame / 60.0, 0, &in);
    panache_character_step(character, stick_input(&in), 1 / 60.0, stick_output(&again));
  }
  free(state);
  printf("rewound and played again: %s\n",
         memcmp(&out, &again, sizeof out) == 0 ? "the same, bit for bit" : "something else");
  panache_character_destroy(character);
  panache_skeleton_destroy(skeleton);
  panache_model_destroy(model);
  return memcmp(&out, &again, sizeof out) == 0 ? 0 : 1;
}

// A clip of the caller's own in the memory of the module, as panache.h has it.
import { checkClip } from './checks.js';
import { kClip } from './structs.js';

export function writeClip(arena, panache, skeleton, clip) {
  return arena.write(kClip, {
    skeleton: skeleton._handleFor(panache), frameCount: checkClip(clip, skeleton.jointCount),
    frameSeconds: clip.frameSeconds, rotations: arena.copy(clip.rotations),
    translations: arena.copy(clip.translations),
  });
}

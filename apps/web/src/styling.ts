// Applies the settings to a player.

import { Playback, type Panache, type Remover, type Walk } from '../package/index.js';
import { strengthAt, type Key } from './keys';
import { personOf, shapeOf, type Settings } from './settings';
import type { Source } from './source';

/** Sets a player's strengths, keyframes, sides, person, shape, timing and gestures, and the style to
 * remove once the remover is loaded. */
export function applySettings(panache: Panache, player: Walk | Playback, settings: Settings,
    remover: Remover | null) {
  if (remover) {
    player.useRemover(remover);
    player.setRemoved(settings.removed || null);
  }
  for (const { name, side } of panache.styles) {
    if (side !== null) player.setSide(name, settings.sides[name] ?? 1);
    player.setStrength(name, (settings.styles[name] ?? 0) * settings.strength);
    if (!(player instanceof Playback)) continue;
    player.setTrack(name, (settings.keys[name] ?? [])
      .map(([seconds, value]): Key => [seconds, value * settings.strength]));
  }
  player.setPerson(personOf(settings), settings.variety);
  player.setShape(shapeOf(settings));
  player.setTiming(settings.tempo);
  player.setGestureRate(settings.gestures);
}

/** Plays a gesture of a source's active styles, if they have any. */
export function triggerAny(panache: Panache, source: Source, settings: Settings) {
  const active = activeStyles(source, settings);
  const all = panache.styles.filter(({ name }) => active.includes(name))
    .flatMap(({ name, gestures }) => gestures.map((_, i): [string, number] => [name, i]));
  if (all.length > 0) source.player.trigger(...all[Math.floor(Math.random() * all.length)]);
}

/** The keyframed strengths at the play head. */
export function keyedNow(source: Source, { keys }: Settings): Record<string, number> {
  if (source.kind !== 'clip') return {};
  const { seconds } = source.player;
  return Object.fromEntries(Object.entries(keys)
    .map(([name, own]) => [name, strengthAt(own, seconds)]));
}

/** The names of a source's active styles. */
export function activeStyles(source: Source, { styles, keys, strength }: Settings): string[] {
  const named = Object.keys(styles).filter((name) => styles[name] * strength !== 0);
  if (source.kind !== 'clip') return named;
  return [...named, ...Object.keys(keys).filter((name) => !named.includes(name))];
}

// Mixes worth a button.

export interface Preset {
  title: string;
  styles: Record<string, number>;
}

export const kPresets: readonly Preset[] = [
  { title: 'Neutral', styles: {} },
  { title: 'Old', styles: { old: 1 } },
  { title: 'Very old', styles: { old: 2 } },
  { title: 'Zombie', styles: { zombie: 1 } },
  { title: 'Proud robot', styles: { robot: 0.8, proud: 0.6 } },
  { title: 'Drunken pirate', styles: { drunk: 0.8, 'dragging a leg': 0.6 } },
  { title: 'Sneaking cat', styles: { cat: 0.7, sneaking: 0.5 } },
  { title: 'Scared chicken', styles: { chicken: 0.8, scared: 0.5 } },
  { title: 'Sulking teenager', styles: { teenager: 0.8, depressed: 0.6 } },
  { title: 'Friday', styles: { joyful: 0.7, strutting: 0.6 } },
];

/** The corners of the pad, as they are at first. */
export const kCorners = ['old', 'proud', 'childlike', 'zombie'] as const;

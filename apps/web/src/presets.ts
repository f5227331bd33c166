// Mixes worth a button.

export interface Preset {
  title: string;
  styles: Record<string, number>;
}

export const kPresets: readonly Preset[] = [
  { title: 'Neutral', styles: {} },
  { title: 'Old', styles: { old: 1 } },
  { title: 'Very old', styles: { old: 2 } },
  { title: 'Proud giant', styles: { proud: 0.6, giant: 0.8 } },
  { title: 'Sad child', styles: { childlike: 0.8, sad: 0.8 } },
  { title: 'Monday', styles: { tired: 1, sad: 0.5 } },
  { title: 'Friday', styles: { happy: 0.9, musical: 0.6 } },
  { title: 'Not old at all', styles: { old: -0.5, youthful: 1 } },
];

/** The corners of the pad, as they are at first. */
export const kCorners = ['old', 'proud', 'sad', 'happy'] as const;

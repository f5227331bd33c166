// The pad: a point between four corners, each of them a style.

/** Shares of the corners (top left, top right, bottom left, bottom right) at x, y in 0 to 1. */
export function shares(x: number, y: number): [number, number, number, number] {
  return [(1 - x) * (1 - y), x * (1 - y), (1 - x) * y, x * y];
}

/** Where on the pad these strengths are; the middle where they are all 0. */
export function place(strengths: readonly number[]): { x: number; y: number } {
  const [a, b, c, d] = strengths.map((s) => Math.max(0, s));
  const sum = a + b + c + d;
  if (sum <= 0) return { x: 0.5, y: 0.5 };
  return { x: (b + d) / sum, y: (c + d) / sum };
}

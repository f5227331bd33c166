// Finds a cycle in a motion.

const kSame = 0.05;     // Metres, mean over all points.
const kGood = 1.25;
const kUnseen = 0.004;  // Metres.

/** Returns frames [first, end): the pose at the end matches the first one, and so does the next
 * pair. `poses`: positions [points][3], metres; `minimum`: frames. null: there is no cycle. */
export function findCycle(poses: readonly Float32Array[], minimum: number):
    [number, number] | null {
  const far = (a: Float32Array, b: Float32Array) => {
    let sum = 0;
    for (let k = 0; k < a.length; k += 3) {
      sum += Math.hypot(a[k] - b[k], a[k + 1] - b[k + 1], a[k + 2] - b[k + 2]);
    }
    return (3 * sum) / a.length;
  };
  const pairs: [number, number, number][] = [];
  for (let i = 0; i + minimum + 1 < poses.length; ++i) {
    for (let j = i + minimum; j + 1 < poses.length; ++j) {
      const distance = Math.max(far(poses[i], poses[j]), far(poses[i + 1], poses[j + 1]));
      if (distance < kSame) pairs.push([i, j, distance]);
    }
  }
  const best = pairs.reduce((min, pair) => Math.min(min, pair[2]), Infinity);
  // Take the shortest cycle that closes about as well as the best.
  const good = pairs.filter((pair) => pair[2] <= kGood * best + kUnseen)
    .sort((a, b) => a[1] - a[0] - (b[1] - b[0]) || a[2] - b[2]);
  return good.length ? [good[0][0], good[0][1]] : null;
}

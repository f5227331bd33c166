// From everyday words to what an avatar shows: styles of Panache with their strengths, and an
// expression of VRM.

export const moods = {
  neutral: { words: ['calm', 'ok', 'okay', 'normal'], styles: {}, face: 'relaxed', weight: 0.2 },
  happy: { words: ['glad', 'great', 'joy', 'joyful', 'yay', 'love', 'thanks', 'wonderful'], styles: { joyful: 0.9 }, face: 'happy' },
  excited: { words: ['wow', 'amazing', 'awesome', 'hooray'], styles: { childlike: 0.8, joyful: 0.5 }, face: 'happy' },
  sad: { words: ['sorry', 'unhappy', 'cry', 'miss', 'lonely', 'alas'], styles: { depressed: 1.2 }, face: 'sad' },
  tired: { words: ['sleepy', 'exhausted', 'bored', 'yawn'], styles: { moping: 1.1 }, face: 'relaxed' },
  angry: { words: ['mad', 'furious', 'hate', 'grr', 'annoying'], styles: { angry: 1.3 }, face: 'angry' },
  scared: { words: ['afraid', 'fear', 'help', 'spooky', 'nervous'], styles: { scared: 1.3 }, face: 'surprised', weight: 0.6 },
  surprised: { words: ['really', 'unbelievable', 'huh'], styles: { scared: 0.4 }, face: 'surprised' },
  shy: { words: ['embarrassed', 'blush', 'timid'], styles: { shy: 1.2 }, face: 'relaxed' },
  proud: { words: ['confident', 'strong', 'winner', 'won'], styles: { proud: 1.2 }, face: 'happy', weight: 0.5 },
  cool: { words: ['chill', 'relaxed', 'smooth'], styles: { strutting: 1 }, face: 'relaxed' },
  sick: { words: ['ill', 'hurt', 'pain', 'ouch', 'unwell'], styles: { 'hurt stomach': 1 }, face: 'sad', weight: 0.8 },
  old: { words: ['elderly', 'grandpa', 'granny'], styles: { old: 1.2 }, face: 'relaxed' },
  drunk: { words: ['tipsy', 'dizzy'], styles: { drunk: 1.1 }, face: 'relaxed', weight: 0.8 },
};

/** The mood with this name or word, or null. */
export function findMood(word) {
  const wanted = word.toLowerCase();
  if (Object.hasOwn(moods, wanted)) return wanted;
  return Object.keys(moods).find((name) => moods[name].words.includes(wanted)) ?? null;
}

/** The mood of a line of text: that of its last word which has one, or null. */
export function moodOf(text) {
  return (text.toLowerCase().match(/\p{L}+/gu) ?? []).map(findMood).filter(Boolean).at(-1) ?? null;
}

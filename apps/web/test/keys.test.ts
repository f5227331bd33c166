import { expect, test } from 'vitest';

import { fromText, moved, strengthAt, toText, withKey, type Key } from '../src/keys';
import { fromAddress, kDefaults, Store, toAddress } from '../src/settings';

const kKeys: Key[] = [[1, 0], [2, 1], [4, 0.5]];

test('between keys the strength goes straight, and outside of them it stays', () => {
  expect([0, 1, 1.25, 2, 3, 9].map((time) => strengthAt(kKeys, time))).toEqual([0, 0, 0.25, 1, 0.75, 0.5]);
});

test('a key goes to its place in time, or replaces the one that is there', () => {
  expect(withKey(kKeys, 3, 2)).toEqual({ keys: [[1, 0], [2, 1], [3, 2], [4, 0.5]], index: 2 });
  expect(withKey(kKeys, 2.0004, -9)).toEqual({ keys: [[1, 0], [2, -0.5], [4, 0.5]], index: 1 });
});

test('a key that is moved stays between its neighbours and before the end', () => {
  expect(moved(kKeys, 1, 9, 0.2, 5)[1]).toEqual([3.992, 0.2]);
  expect(moved(kKeys, 2, 9, 0.2, 5)[2]).toEqual([5, 0.2]);
  expect(moved(kKeys, 0, -1, 0, 5)[0]).toEqual([0, 0]);
});

test('keys come back from the address, and nonsense does not', () => {
  expect(fromText(toText(kKeys))).toEqual(kKeys);
  expect(fromText('1_0*x_1*2*3_*_4*4_0.5')).toEqual([[1, 0], [4, 0.5]]);
  const address = toAddress({ ...kDefaults, keys: { old: kKeys } });
  expect(address).toBe('keys.old=1_0*2_1*4_0.5');
  expect(fromAddress('old.keys=1_0*2_1*4_0.5', ['old'], []).keys).toEqual({ old: kKeys });
  expect(fromAddress(address, ['old'], []).keys).toEqual({ old: kKeys });
  expect(fromAddress(address, ['proud'], []).keys).toEqual({});
});

test('styles that are gone are gone from what can be undone too', () => {
  const store = new Store({ ...kDefaults, styles: { mine: 1, old: 0.5 }, keys: { mine: kKeys } });
  store.set({ strength: 0.5 });
  store.keepStyles(['old']);
  expect(store.settings.styles).toEqual({ old: 0.5 });
  store.undo();
  expect(store.settings).toEqual({ ...kDefaults, styles: { old: 0.5 }, keys: {} });
});

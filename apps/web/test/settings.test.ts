import { afterEach, describe, expect, it, vi } from 'vitest';

import { bounded } from '../src/keys';
import {
  fromAddress as read, kDefaults, kOpening, personOf, shapeOf, Store, toAddress,
} from '../src/settings';
import { otherSide } from '../src/side';

const kStyles = ['old', 'proud'];
const fromAddress = (text: string, styles: readonly string[]) => read(text, styles, ['any', 'drunk']);

describe('the address', () => {
  it('says nothing of what is as it always is', () => {
    expect(toAddress(kOpening)).toBe('');
    expect(fromAddress('', kStyles)).toEqual(kOpening);
    expect(toAddress(kDefaults)).toBe('neutral');
    expect(fromAddress('#neutral', kStyles)).toEqual(kDefaults);
  });
  it('brings back whatever was set', () => {
    const set = {
      ...kDefaults, styles: { old: 1.25, proud: -0.5 }, strength: 0.5, posture: 0, timing: 2,
      tempo: 'all' as const, removed: 'drunk',
      legs: false, feet: false, trail: false, view: 'over' as const, gestures: 0,
      sides: { old: -1, proud: 0.5 },
    };
    expect(fromAddress(`#${toAddress(set)}`, kStyles)).toEqual(set);
  });
  it('is believed as far as it makes sense', () => {
    const settings = fromAddress('#old=9&proud=x&angry=1&posture=&legs=maybe&tempo=fast&view=up&removed=old',
      kStyles);
    expect(settings).toEqual({ ...kDefaults, styles: { old: 2 } });
  });
});

describe('a style that is called as a setting is', () => {
  const names = ['view', 'tempo', 'removed', 'legs', 'strength', 'posture', 'trail', 'neutral', 'old', 'old.keys',
    'style.old', 'keys.old', 'a=b&c#%', '__proto_'];
  it('has a link of its own, and leaves the setting alone', () => {
    for (const name of names) {
      const keys = [[1, 0.5]] as const;
      const sets = [
        { ...kDefaults, styles: { [name]: 0.5 } },
        { ...kDefaults, keys: { [name]: keys } },
        { ...kDefaults, styles: { [name]: 0.5 }, view: 'over' as const, legs: false, strength: 0.3 },
        { ...kDefaults, view: 'over' as const, legs: false, strength: 0.3, trail: false },
      ];
      for (const set of sets) expect(fromAddress(`#${toAddress(set)}`, names), name).toEqual(set);
    }
  });
  it('is not what an older link means', () => {
    const link = fromAddress('#old=1&view=over&legs=off&strength=0.5', names);
    expect(link).toEqual(
      { ...kDefaults, styles: { old: 1 }, view: 'over', legs: false, strength: 0.5 });
    expect(fromAddress('#proud=0.5', ['proud'])).toEqual({ ...kDefaults, styles: { proud: 0.5 } });
  });
});

describe('the side of a style', () => {
  it('is in the address as a word, and gone as captured', () => {
    const store = new Store({ ...kDefaults });
    store.setSide('old', -1);
    expect(toAddress(store.settings)).toBe('side.old=mirrored');
    store.setSide('old', 1);
    expect(store.settings).toEqual(kDefaults);
    expect(fromAddress('#side.old=x&side.proud=7&side.odd=-1', kStyles)).toEqual(kDefaults);
  });
  it('goes with its style and comes back with undo', () => {
    const store = new Store({ ...kDefaults });
    vi.spyOn(performance, 'now').mockReturnValueOnce(0).mockReturnValueOnce(1e4);
    store.setSide('old', -1);
    store.dropStyle('old');
    expect(store.settings.sides).toEqual({});
    store.undo();
    expect(store.settings.sides).toEqual({ old: -1 });
    store.keepStyles(['proud']);
    expect(store.settings.sides).toEqual({});
    vi.restoreAllMocks();
  });
  it('is told by the phrase of the model with the other word', () => {
    expect(otherSide('right leg')).toBe('left leg');
    expect(otherSide('to the left')).toBe('to the right');
  });
});

describe('a number', () => {
  it('is brought within its bounds and to two decimals', () => {
    expect(bounded(1.2345, 0, 2, 1)).toBe(1.23);
    expect(bounded(-7, -0.5, 2, 0)).toBe(-0.5);
    expect(bounded(NaN, 0, 2, 1)).toBe(1);
    expect(Object.is(bounded(-0.001, -0.5, 2, 1), 0)).toBe(true);
  });
});

describe('the store', () => {
  it('tells of every change, and forgets styles at nothing', () => {
    const store = new Store({ ...kDefaults });
    const heard: string[] = [];
    store.listen((settings) => heard.push(toAddress(settings)));
    store.setStyle('old', 0.5);
    store.setStyle('old', 0);
    expect(heard).toEqual(['neutral', 'style.old=0.5', 'neutral']);
  });
});

describe('undo', () => {
  afterEach(() => vi.restoreAllMocks());
  it('takes back what was done in one go, and does it again', () => {
    let now = 0;
    vi.spyOn(performance, 'now').mockImplementation(() => now);
    const store = new Store({ ...kDefaults });
    store.setStyle('old', 0.2);
    now = 100;
    store.setStyle('old', 0.6);  // Part of the same drag.
    now = 2000;
    store.set({ legs: false });
    store.undo();
    expect(store.settings).toEqual({ ...kDefaults, styles: { old: 0.6 } });
    store.undo();
    expect(store.settings).toEqual(kDefaults);
    expect(store.canUndo).toBe(false);
    store.redo();
    store.redo();
    expect(store.settings).toEqual({ ...kDefaults, styles: { old: 0.6 }, legs: false });
    store.undo();
    store.set({ feet: false });  // This clears the redo list.
    expect(store.canRedo).toBe(false);
  });
  it('does not count what changes nothing', () => {
    const store = new Store({ ...kDefaults });
    store.set({ legs: true });
    expect(store.canUndo).toBe(false);
  });
});

describe('the person', () => {
  const person = (text: string) => personOf(read(text, [], []));
  it('is a number, a word or nobody', () => {
    expect(person('person=7&variety=1.5')).toBe('7');
    expect(person('person=Mara')).toBe('Mara');
    expect(person('variety=0.5')).toBe(null);
    expect(toAddress({ ...kDefaults, person: 'Mara', variety: 0.5, view: 'crowd', mixed: true }))
      .toBe('person=Mara&variety=0.5&mixed=on&view=crowd');
  });
});

describe('the shape', () => {
  it('turns switches into weights', () => {
    expect(shapeOf({ ...kDefaults, leftArm: false, feet: false, dynamics: 0.5 })).toEqual({
      posture: 1, dynamics: 0.5, timing: 1, legs: 1, torso: 1, leftArm: 0, rightArm: 1, footLock: 0,
      handContacts: 1, energy: 1,
    });
  });
});

"""Nothing that Python code does to arrays makes the library read or write memory that is not
theirs."""

import copy
import dataclasses
import gc

import numpy as np
import pytest

import panache


def play(character, walk, frames):
    out = []
    for f in frames:
        character.input_rotations[:] = walk.rotations[f]
        character.input_translations[:] = walk.translations[f]
        character.step(1 / 60)
        out.append(character.rotations.tobytes() + character.translations.tobytes())
    return out


@pytest.fixture
def character(model, walk):
    one = panache.Character(model, walk.skeleton)
    one.set_strength('old', 1)
    return one


def test_an_array_assigned_to_an_input_is_copied_and_is_what_a_step_reads(model, walk, character):
    other = panache.Character(model, walk.skeleton)
    other.set_strength('old', 1)
    expected = play(other, walk, range(40))
    rotations, translations = character.input_rotations, character.input_translations
    for f in range(40):
        # Also in another type and order.
        character.input_rotations = np.asfortranarray(walk.rotations[f], np.float64)
        character.input_translations = walk.translations[f].tolist()
        gc.collect()
        garbage = [np.full_like(rotations, np.nan) for _ in range(8)]
        character.step(1 / 60)
        del garbage
        assert character.rotations.tobytes() + character.translations.tobytes() == expected[f]
    assert character.input_rotations is rotations and character.input_translations is translations


def test_an_input_of_another_shape_is_rejected_and_changes_nothing(walk, character):
    character.input_rotations = walk.rotations[3]
    for bad in (walk.rotations[3][:5], walk.rotations, walk.rotations[3][0], 1.0):
        with pytest.raises(panache.PanacheError, match='rotations: expected an array of shape'):
            character.input_rotations = bad
        with pytest.raises(panache.PanacheError, match='translations: expected an array of shape'):
            character.input_translations = bad
    assert np.array_equal(character.input_rotations, walk.rotations[3])


def test_outputs_cannot_be_replaced_and_no_array_can_be_resized_or_removed(character):
    for name in ('rotations', 'translations'):
        with pytest.raises(AttributeError):
            setattr(character, name, np.zeros((1, 4), np.float32))
    for name in ('rotations', 'translations', 'input_rotations', 'input_translations'):
        with pytest.raises(AttributeError):
            delattr(character, name)
        with pytest.raises(ValueError):
            getattr(character, name).resize((1, 4), refcheck=False)


def test_a_crowd_reads_what_is_assigned_and_steps_whom_it_was_made_of(model, walk):
    characters = [panache.Character(model, walk.skeleton) for _ in range(3)]
    for one in characters:
        one.set_strength('moping', 1)
    crowd = panache.Crowd(characters)
    alone = panache.Character(model, walk.skeleton)
    alone.set_strength('moping', 1)
    with pytest.raises(AttributeError):
        crowd.characters.append(alone)
    with pytest.raises(AttributeError):
        crowd.characters = characters * 9
    for f in range(20):
        for one in (*characters, alone):
            one.input_rotations, one.input_translations = walk.rotations[f], walk.translations[f]
        crowd.step(1 / 60)
        alone.step(1 / 60)
    del crowd
    for one in characters:
        assert one.rotations.tobytes() == alone.rotations.tobytes()


def test_a_crowd_keeps_its_characters(model, walk):
    crowd = panache.Crowd([panache.Character(model, walk.skeleton) for _ in range(20)])
    gc.collect()
    crowd.step(1 / 60)


def test_characters_are_not_copied(model, walk, character):
    with pytest.raises(TypeError, match='cannot be copied'):
        copy.deepcopy(character)
    assert panache.Character(copy.copy(model), walk.skeleton).report().gate >= 0


def test_a_clip_cannot_be_given_other_arrays(walk):
    for name in ('rotations', 'translations', 'skeleton', 'frame_seconds'):
        with pytest.raises(dataclasses.FrozenInstanceError):
            setattr(walk, name, getattr(walk, name))
    with pytest.raises(panache.PanacheError, match='translations: expected'):
        dataclasses.replace(walk, translations=walk.translations[:1])


def test_a_clip_whose_array_was_resized_or_reshaped_is_rejected_at_each_use(model, walk):
    def clip():
        return panache.Clip(walk.skeleton, np.array(walk.rotations), np.array(walk.translations),
                            walk.frame_seconds)
    frames, joints = walk.rotations.shape[:2]

    def resized(one):
        one.translations.resize((1, joints, 3), refcheck=False)

    def reshaped(one):
        one.rotations.shape = (frames * joints, 4)

    def retyped(one):
        one.rotations.dtype = np.int32

    for spoil in (resized, reshaped, retyped):
        for use in (lambda one: panache.stylize(model, one, {'old': 1}),
                    lambda one: panache.retarget(one, walk.skeleton),
                    lambda one: panache.learn(model, [(walk, one)], 'mine'),
                    lambda one: panache.training_samples(one),
                    lambda one: panache.training_samples((walk, one))):
            one = clip()
            spoil(one)
            with pytest.raises(panache.PanacheError):
                use(one)


def test_a_clip_of_another_type_or_order_is_the_same(model, walk):
    expected = panache.stylize(model, walk, {'old': 1})
    other = panache.Clip(walk.skeleton, np.asfortranarray(walk.rotations),
                         walk.translations.astype(np.float64)[::1], walk.frame_seconds)
    assert panache.stylize(model, other, {'old': 1}).rotations.tobytes() == \
        expected.rotations.tobytes()

"""Objects in other processes and threads."""

import concurrent.futures
import copy
import multiprocessing
import pickle

import numpy as np
import pytest

import panache


def bits(clip):
    return clip.rotations.tobytes() + clip.translations.tobytes()


def styled_bits(model, clip):
    """What a worker does."""
    return bits(panache.stylize(model, clip, {'old': 1}))


def test_workers_take_models_and_clips_and_give_the_same_bits(model, walk):
    expected = styled_bits(model, walk)
    for method in ('spawn', 'fork'):
        context = multiprocessing.get_context(method)
        with concurrent.futures.ProcessPoolExecutor(1, mp_context=context) as pool:
            assert pool.submit(styled_bits, model, walk).result() == expected, method
            old = pool.submit(panache.stylize, model, walk, {'old': 1}).result()
            assert bits(old) == expected
    assert isinstance(old, panache.StyledClip)
    assert old.contacts.shape == (len(old), 2) and old.is_loop in (False, True)


def test_a_skeleton_of_a_file_stays_itself(walk_file, model, tmp_path):
    path = tmp_path / 'gone.bvh'
    path.write_bytes(walk_file.read_bytes())
    file = panache.MotionFile(path, fps=50)
    told = file.skeleton(human_joints={'leftShoulder': -1}, metres_per_unit=0.02)
    rest = file.skeleton(-1)
    whole = pickle.dumps((file, told, rest, file.clip()))
    path.unlink()  # What was read counts.
    file_again, told_again, rest_again, clip = pickle.loads(whole)
    assert file_again.joint_names == file.joint_names
    assert clip.frame_seconds == file.clip().frame_seconds == 1 / 50
    assert told_again.mapping() == told.mapping() != file.skeleton().mapping()
    for skeleton, again in ((told, told_again), (rest, rest_again), (told, copy.deepcopy(told))):
        original, copied = (
            panache.stylize(model, panache.Clip(one, clip.rotations, clip.translations, 1 / 50),
                            {'proud': 1}) for one in (skeleton, again))
        assert bits(original) == bits(copied)


def test_a_skeleton_of_arrays_stays_itself(walk_file, walk, model):
    rest = panache.MotionFile(walk_file).clip(0).translations[0].copy()
    turns = np.tile(np.float32([0, 0, 0, 1]), (len(rest), 1))
    skeleton = panache.Skeleton(
        walk.skeleton.joint_names, walk.skeleton.parents, turns, rest, up_axis='+Y',
        poses=(walk.rotations[:5], walk.translations[:5]), human_joints={'leftToes': -1})
    clip = panache.Clip(skeleton, walk.rotations, walk.translations, walk.frame_seconds)
    expected = styled_bits(model, clip)
    rest[:] = 0  # The caller's own array.
    again = pickle.loads(pickle.dumps(clip))
    assert again.skeleton.mapping() == skeleton.mapping()
    assert again.skeleton.mapping()['leftToes'] is None
    assert styled_bits(model, again) == expected


def test_a_model_of_a_learnt_style_reaches_a_worker(model, walk):
    bent = panache.stylize(model, walk, {'old': 1}, timing='off')
    learnt = panache.learn(model, [(walk, bent)], 'mine')
    again = pickle.loads(pickle.dumps(learnt))
    assert again.model.styles == learnt.model.styles and 'mine' in again.model.styles
    assert again.model.content == learnt.model.content


@pytest.mark.parametrize('count, threads', [(7, 2), (7, 3), (2, 5), (0, 4), (5, 0), (5, np.int64(2))])
def test_a_crowd_of_threads_has_the_bits_of_one(model, walk, count, threads):
    crowds = [panache.Crowd([panache.Character(model, walk.skeleton) for _ in range(count)],
                            threads=n) for n in (1, threads)]
    assert 1 <= crowds[1].threads <= max(count, 1)
    for frame in range(20):
        for crowd in crowds:
            for i, character in enumerate(crowd.characters):
                character.set_strength(model.styles[i], 1)
                character.input_rotations[:] = walk.rotations[frame + 3 * i]
                character.input_translations[:] = walk.translations[frame + 3 * i]
            crowd.step(1 / 60)
    for one, other in zip(crowds[0].characters, crowds[1].characters):
        assert one.rotations.tobytes() == other.rotations.tobytes()
        assert one.rotations.tobytes() != one.input_rotations.tobytes()


def test_a_crowd_steps_in_a_fork_too(model, walk):
    crowd = panache.Crowd([panache.Character(model, walk.skeleton) for _ in range(4)], threads=2)
    crowd.step(1 / 60)
    child = multiprocessing.get_context('fork').Process(target=crowd.step, args=(1 / 60,))
    child.start()
    child.join(60)
    assert child.exitcode == 0


def test_a_crowd_tells_what_is_wrong_with_its_threads(model, walk):
    character = panache.Character(model, walk.skeleton)
    for bad in (-1, 257, 1.5, 'two'):
        with pytest.raises(panache.PanacheError, match='threads: expected'):
            panache.Crowd([character], threads=bad)
    with pytest.raises(panache.PanacheError, match='seconds: expected a number'):
        panache.Crowd([character]).step('soon')

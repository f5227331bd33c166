"""The Python package against the program and the library."""

import ctypes
import json
import os
import pathlib
import subprocess
import sys
import time

import numpy as np
import pytest

import panache
from conftest import angles
from panache._interface import structs


def test_the_package_comes_from_the_wheel():
    assert pathlib.Path(panache.__file__).is_relative_to(sys.prefix)
    assert (pathlib.Path(panache.__file__).parent / 'py.typed').exists()
    assert panache.__version__.startswith('0.')


def test_structs_are_those_of_the_header():
    seen = 0
    lines = subprocess.run([os.environ['PANACHE_STRUCT_SIZES']], check=True, capture_output=True,
                           text=True).stdout.split('\n')
    for line in filter(None, lines):
        name, size, *fields = line.split()
        struct = getattr(structs, name.title().replace('_', ''))
        assert ctypes.sizeof(struct) == int(size), name
        assert [text for field, _ in struct._fields_
                for text in (field, str(getattr(struct, field).offset))] == fields, name
        seen += 1
    assert seen == len(vars(structs))


def test_shipped_models_load_and_their_tensors_are_arrays():
    assert {'panache', 'panache-int8', 'remover-int8', 'smith2019'} <= set(panache.shipped_models())
    for name in panache.shipped_models():
        model = panache.Model(name)
        tensors = model.tensors()
        assert model.metadata['format'] == 'panache'
        assert tensors['input.mean'].dtype == np.float32
        assert len(tensors['input.mean']) == (130 if name == 'smith2019' else 66)
        weight = tensors['pose.trunk.0.weight']
        assert weight.dtype == (np.int8 if name.endswith('-int8') else np.float32)
        assert weight.shape[0] >= 396
        with pytest.raises(ValueError):
            weight[0, 0] = 1
    assert 'old' in panache.Model('panache').styles


def test_a_style_is_told_and_taken_off(model, walk):
    old = panache.stylize(model, walk, {'old': 1})
    told = old.styles()
    assert 'neutral' in told and 'any' not in told
    assert sum(told.values()) == pytest.approx(1, abs=0.01)
    assert told['old'] > walk.styles()['old']
    removed = panache.stylize(model, old, {}, remove='old')
    assert removed.styles()['old'] < told['old']
    with pytest.raises(panache.PanacheError, match='unknown style'):
        panache.stylize(model, old, {}, remove='odl')
    with pytest.raises(panache.PanacheError, match='expected remove'):
        panache.stylize(model, old, {}, remover=panache.Model('remover-int8'))


def test_a_character_takes_a_style_off(model, walk):
    character = panache.Character(model, walk.skeleton, remover=panache.Model('remover-int8'))
    character.stylize(walk.rotations[0], walk.translations[0], 1 / 30)
    character.set_removed('old')
    for rotations, translations in zip(walk.rotations[1:30], walk.translations[1:]):
        out, _ = character.stylize(rotations, translations, 1 / 30)
    assert not np.array_equal(out, walk.rotations[29])
    character.set_removed(None)
    with pytest.raises(panache.PanacheError, match='remover'):
        panache.Character(model, walk.skeleton).set_removed('old')


def test_a_clip_is_read_without_copies_and_strength_0_is_it(model, walk):
    assert walk.rotations.dtype == np.float32 and len(walk) == 240
    assert not walk.rotations.flags.owndata and not walk.rotations.flags.writeable
    same = panache.stylize(model, walk, {'old': 0})
    assert same.rotations.tobytes() == walk.rotations.tobytes()
    assert same.translations.tobytes() == walk.translations.tobytes()
    assert same.source_frames.tolist() == list(range(240))
    own = np.array(walk.rotations)
    assert panache.Clip(walk.skeleton, own, walk.translations, 1 / 60).rotations is own


@pytest.mark.parametrize('styles', [{'old': 1}, {'proud': 0.7, 'angry': 0.25}])
def test_a_file_is_restyled_to_the_programs_bytes(styles, walk_file, shipped, run, tmp_path):
    panache.stylize_file(walk_file, tmp_path / 'a.bvh', styles)
    wishes = [f'--style={name}={strength}' for name, strength in styles.items()]
    run('stylize', walk_file, '--model', shipped, *wishes, '-o', tmp_path / 'b.bvh')
    assert (tmp_path / 'a.bvh').read_bytes() == (tmp_path / 'b.bvh').read_bytes()
    assert (tmp_path / 'a.bvh').read_bytes() != walk_file.read_bytes()


def test_a_glb_with_two_motions_is_restyled_to_the_programs_bytes(walk_file, shipped, run,
                                                                  tmp_path):
    run('convert', walk_file, '-o', tmp_path / 'one.glb')
    run('stylize', tmp_path / 'one.glb', '--model', shipped, '--style', 'moping=1', '-o',
        tmp_path / 'two.glb')
    assert panache.MotionFile(tmp_path / 'two.glb').clip_names == ['walk (moping 1)', 'walk']
    for timing, word in ((False, 'off'), ('all', 'all'), ('steps', 'steps')):
        panache.stylize_file(tmp_path / 'two.glb', tmp_path / 'a.glb', {'old': 1.5}, timing=timing,
                             force=True)
        run('stylize', tmp_path / 'two.glb', '--model', shipped, '--style', 'old=1.5', '--timing',
            word, '-o', tmp_path / 'b.glb', '--force')
        assert (tmp_path / 'a.glb').read_bytes() == (tmp_path / 'b.glb').read_bytes()
    assert len(panache.MotionFile(tmp_path / 'a.glb').clip_names) == 4


def test_a_file_is_retargeted_to_the_programs_bytes(walk_file, run, tmp_path):
    larger = tmp_path / 'larger.bvh'
    lines = walk_file.read_text().split('\n')
    head = lines.index('MOTION')
    for i, line in enumerate(lines[:head]):
        if 'OFFSET' in line:
            before, numbers = line.split('OFFSET')
            lines[i] = f'{before}OFFSET ' + ' '.join(f'{1.3 * float(x):g}' for x in numbers.split())
    larger.write_text('\n'.join(lines))
    for character in (larger, walk_file):
        panache.retarget_file(walk_file, character, tmp_path / 'a.bvh', force=True)
        run('retarget', walk_file, '--onto', character, '-o', tmp_path / 'b.bvh', '--force')
        assert (tmp_path / 'a.bvh').read_bytes() == (tmp_path / 'b.bvh').read_bytes()
    run('convert', larger, '-o', tmp_path / 'hero.glb')
    panache.retarget_file(walk_file, tmp_path / 'hero.glb', tmp_path / 'a.glb')
    run('retarget', walk_file, '--onto', tmp_path / 'hero.glb', '-o', tmp_path / 'b.glb')
    assert (tmp_path / 'a.glb').read_bytes() == (tmp_path / 'b.glb').read_bytes()


def test_steps_have_the_bits_of_c(model, walk_file, shipped, walk,
                                                             tmp_path):
    character = panache.Character(model, walk.skeleton)
    character.set_strength('old', 1)
    times, poses = [], []
    for turn in range(20):
        character.reset()
        poses.clear()
        for rotations, translations in zip(walk.rotations, walk.translations):
            character.input_rotations[:] = rotations
            character.input_translations[:] = translations
            begin = time.perf_counter_ns()
            character.step(walk.frame_seconds)
            times.append(time.perf_counter_ns() - begin)
            poses += [character.rotations.tobytes(), character.translations.tobytes()]
    in_c = float(subprocess.run([os.environ['PANACHE_C_STEP'], shipped, walk_file, tmp_path / 'c'],
                                check=True, capture_output=True, text=True).stdout)
    here = np.median(times) / 1000
    print(f'\na step: {here:.2f} us from Python, {in_c:.2f} us from C')
    assert b''.join(poses) == (tmp_path / 'c').read_bytes()


def test_a_crowd_and_a_pose_in_other_arrays_are_as_alone(model, walk):
    characters = [panache.Character(model, walk.skeleton) for _ in range(12)]
    alone = panache.Character(model, walk.skeleton)
    for character in (*characters, alone):
        character.set_strength('proud', 0.8)
    crowd = panache.Crowd(characters)
    for rotations, translations in zip(walk.rotations[:40], walk.translations):
        for character in characters:
            character.input_rotations[:] = rotations
            character.input_translations[:] = translations
        crowd.step(walk.frame_seconds)
        one = alone.stylize(rotations.astype(np.float64), translations, walk.frame_seconds)
    for character in characters:
        assert character.rotations.tobytes() == one[0].tobytes()
        assert character.translations.tobytes() == one[1].tobytes()
    assert one[0].tobytes() != rotations.tobytes()


def test_a_character_is_saved_shaped_and_reports(model, walk):
    def play(character, frames):
        return b''.join(character.stylize(walk.rotations[f], walk.translations[f], 1 / 60)[0]
                        .tobytes() for f in frames)
    character = panache.Character(model, walk.skeleton, hold_feet=False)
    character.set_strength('old', 1)
    play(character, range(60))
    state = character.save()
    first = play(character, range(60, 90))
    report = character.report()
    assert 0 < report.gate <= 1 and 0.5 <= report.rate <= 2 and report.ahead == 0
    character.restore(state)
    assert play(character, range(60, 90)) == first
    character.restore(state)
    character.set_shape(left_arm=0)
    assert play(character, range(60, 90)) != first
    with pytest.raises(panache.PanacheError, match='state'):
        character.restore(state[:-4])
    with pytest.raises(panache.PanacheError, match="there is no amount 'arm' of a shape"):
        character.set_shape(arm=1)


def test_a_body_on_a_vehicle_keeps_its_style_where_the_limit_allows_its_speed(model, walk):
    moved = np.array(walk.translations)  # In metres.
    moved[:, 0, 0] += 30 * walk.frame_seconds * np.arange(len(walk))
    train = panache.Clip(walk.skeleton, walk.rotations, moved, walk.frame_seconds)

    def live(**options):
        character = panache.Character(model, walk.skeleton, **options)
        character.set_strength('old', 1)
        return b''.join(character.stylize(train.rotations[f], moved[f], 1 / 60)[0].tobytes()
                        for f in range(60))
    assert live(max_speed=0) == live(max_speed=np.inf) == live(max_speed=40) != live()
    free, bound = (panache.stylize(model, train, {'old': 1}, max_speed=speed) for speed in (0, 15))
    assert free.rotations.tobytes() != bound.rotations.tobytes()
    with pytest.raises(panache.PanacheError, match='max_speed of -1'):
        live(max_speed=-1)


def test_a_skeleton_is_made_of_arrays(model, walk_file):
    file = panache.MotionFile(walk_file)
    rest = panache.MotionFile(walk_file).clip(0)
    count = len(file.joint_names)
    identity = np.tile([0.0, 0, 0, 1], (count, 1))
    skeleton = panache.Skeleton(file.joint_names, file.parents, identity, rest.translations[0],
                                poses=(rest.rotations[:9], rest.translations[:9]))
    assert skeleton.mapping()['leftHand'] == rest.skeleton.mapping()['leftHand'] is not None
    told = panache.Skeleton(file.joint_names, file.parents, identity, rest.translations[0],
                            poses=(rest.rotations[:9], rest.translations[:9]),
                            human_joints={'chest': -1})
    assert told.mapping()['chest'] is None
    clip = panache.Clip(skeleton, rest.rotations, rest.translations, rest.frame_seconds)
    assert angles(panache.stylize(model, clip, {'old': 1}, timing=False).rotations,
                  rest.rotations).max() > 0.1


def test_a_loop_stays_one(model, walk):
    moving = [j for j, parent in enumerate(walk.skeleton.parents) if parent >= 0]  # It turns.
    far = [angles(walk.rotations[f], walk.rotations[9])[moving].max()
           for f in range(40, len(walk))]
    end = 40 + int(np.argmin(far))
    cut = panache.Clip(walk.skeleton, walk.rotations[9:end + 1], walk.translations[9:end + 1],
                       walk.frame_seconds)
    styled = panache.stylize(model, cut, {'old': 1})
    assert styled.is_loop and not panache.stylize(model, cut, {'old': 1}, loop='off').is_loop
    assert np.abs(np.abs((styled.rotations[0] * styled.rotations[-1])[moving].sum(-1)) - 1).max() \
        < 1e-4
    with pytest.raises(panache.PanacheError, match="loop: expected 'auto', 'on' or 'off'"):
        panache.stylize(model, cut, {'old': 1}, loop=True)


def test_a_strength_follows_its_keys(model, walk):
    styled = panache.stylize(model, walk, {'old': [(1, 0), (3, 1)]}, timing=False, hold_feet=False)
    assert np.array_equal(styled.rotations[:55], walk.rotations[:55])
    assert angles(styled.rotations, walk.rotations).max(1)[-30:].min() > 0.1


def test_a_style_is_learnt_from_one_clip(model, walk):
    styled = panache.stylize(model, walk, {'old': 1})
    alone = panache.learn(model, styled, 'mine')
    assert alone.model.styles == model.styles + ['mine']
    assert alone.people >= 5 and 0 < alone.certainty < 1
    pair = panache.learn(model, [(walk, styled)], 'mine')
    assert pair.people is None and pair.certainty is None
    assert 'neutral' not in panache.shipped_models()


def test_a_style_is_learnt_from_clips_and_from_files(model, walk, walk_file, shipped, run,
                                                     tmp_path):
    styled = panache.stylize(model, walk, {'old': 1})
    learnt = panache.learn(model, [(walk, styled)], 'mine')
    assert learnt.model.styles == model.styles + ['mine']
    assert learnt.held_back_cm < learnt.untouched_cm
    assert learnt.verdict == 'good'
    mine = panache.stylize(learnt.model, walk, {'mine': 1}, timing=False)
    same = panache.stylize(model, walk, {'old': 1}, timing=False)
    assert angles(mine.rotations, same.rotations).mean() < \
        angles(walk.rotations, same.rotations).mean() / 2
    # From files, and by the program: the same numbers, but for the origin that names the files.
    panache.stylize_file(walk_file, tmp_path / 'old.bvh', {'old': 1})
    by_files = panache.learn(model, [(walk_file, tmp_path / 'old.bvh')], 'mine').model
    (tmp_path / 'm.safetensors').write_bytes(model.content)
    run('learn', walk_file, tmp_path / 'old.bvh', '--name', 'mine', '--into',
        tmp_path / 'm.safetensors')
    of_program = panache.Model(tmp_path / 'm.safetensors').tensors()
    for name, tensor in by_files.tensors().items():
        assert tensor.tobytes() == of_program[name].tobytes(), name
    again = by_files.remove('mine').add(by_files.extract('mine'))
    assert again.styles == by_files.styles
    with pytest.raises(panache.PanacheError, match='mine'):
        panache.learn(by_files, [(walk_file, tmp_path / 'old.bvh')], 'mine')


def test_training_samples_are_windows_and_what_the_style_does(model, walk, walk_file):
    neutral = panache.training_samples(walk_file)
    assert neutral.windows.shape == (120, 396) and not neutral.changes.any()
    assert np.array_equal(neutral.windows[57, :66], neutral.windows[60, 132:198])
    styled = panache.stylize(model, walk, {'old': 1})
    pair = panache.training_samples((walk, styled))
    assert pair.windows.shape[1:] == (396,) and pair.changes.shape == (len(pair), 67)
    assert np.abs(pair.changes).mean() > 0.03
    assert pair.log_rates.any() and np.abs(pair.log_rates).max() < 1.11  # The logarithm of 3.
    assert set(np.unique(pair.contacts)) == {0, 1}
    both = panache.training_samples(walk_file, (walk, styled))
    assert len(both) == len(neutral) + len(pair)


def test_info_tells_of_motions_and_models(walk_file, shipped, tmp_path):
    walk = panache.info(walk_file)
    assert walk['clips'] == [{'name': '', 'frames': 240, 'seconds': pytest.approx(4, abs=0.01),
                              'moves': True}]
    assert walk['notes'] == []
    assert walk['mapping']['hips'] in walk['joints']
    assert panache.info(shipped)['metadata']['recipe'] == 'panache'
    (tmp_path / 'rod.bvh').write_text(
        'HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\nEnd Site\n{\nOFFSET 0 1 0\n}\n}\n'
        'MOTION\nFrames: 1\nFrame Time: 0.1\n0\n')
    rod = panache.info(tmp_path / 'rod.bvh')
    assert rod['mapping'] is None and 'rod.bvh: ' in rod['error']


def test_errors_are_the_librarys_sentences(model, walk, walk_file, shipped, tmp_path):
    def rejection(function, *arguments, **options):
        with pytest.raises(panache.PanacheError) as caught:
            function(*arguments, **options)
        return str(caught.value)
    broken = tmp_path / 'broken.bvh'
    broken.write_text(walk_file.read_text()[:400])
    assert rejection(panache.read, broken).startswith(f'{broken}:')
    assert rejection(panache.read, tmp_path / 'none.bvh') == \
        f'{tmp_path}/none.bvh: cannot be read: No such file or directory'
    assert rejection(panache.read, shipped).startswith(
        f'{shipped}: expected a motion file (.bvh, .glb, .gltf, .vrm, .vrma, .amc, .fbx), found')
    assert 'safetensors' in rejection(panache.Model, b'nothing')
    assert rejection(panache.Model, 'no-such').startswith('no-such: cannot be read')
    assert rejection(panache.stylize, model, walk, {'odl': 1}).startswith(
        "unknown style 'odl'; the nearest is old")
    bad = np.array(walk.rotations)
    bad[3, 1] = np.nan
    assert rejection(panache.stylize, model, panache.Clip(
        walk.skeleton, bad, walk.translations, 1 / 60), {'old': 1}) == \
        'clip: pose 3, joint 1: its rotation is not a unit quaternion (x, y, z, w)'
    assert rejection(panache.Clip, walk.skeleton, bad[:, :5], walk.translations, 1 / 60).startswith(
        'rotations: expected an array of shape (any, ')
    assert rejection(panache.stylize_file, walk_file, tmp_path / 'o.glb', {'old': 1}).startswith(
        f'{tmp_path}/o.glb: expected a name that ends in .bvh')
    (tmp_path / 'o.bvh').write_text('mine')
    assert rejection(panache.stylize_file, walk_file, tmp_path / 'o.bvh', {'old': 1}) == \
        f'{tmp_path}/o.bvh: exists already; force=True overwrites it'
    assert (tmp_path / 'o.bvh').read_text() == 'mine'
    panache.stylize_file(walk_file, tmp_path / 'o.bvh', {'old': 1}, force=True)
    assert sorted(path.name for path in tmp_path.iterdir()) == ['broken.bvh', 'o.bvh']


def test_mistakes_with_types_and_numbers_are_sentences_too(model, walk, walk_file, monkeypatch):
    def rejection(function, *arguments, **options):
        with pytest.raises(panache.PanacheError) as caught:
            function(*arguments, **options)
        assert len(str(caught.value)) < 400
        return str(caught.value)
    for kind in (bytearray, memoryview):
        assert panache.Model(kind(model.content)).styles == model.styles
        assert 'safetensors' in rejection(panache.Model, kind(b'x' * 100000))
    assert rejection(panache.Model, 7) == 'model: expected a path, a name or bytes, found int'
    character = panache.Character(model, walk.skeleton)
    for strength in ('much', None, [1]):
        assert rejection(character.set_strength, 'old', strength).startswith(
            'old: expected a number, found')
        rejection(panache.stylize, model, walk, {'old': strength})
    assert rejection(character.set_strength, 5, 1) == 'style: expected a string, found int'
    rejection(character.set_shape, legs='much')
    assert rejection(panache.learn, model, [(walk, 3)], 'mine') == \
        'expected a Clip or a path, found int'
    for pairs in ([walk], [(walk,)], [(walk, walk, walk)]):
        rejection(panache.learn, model, pairs, 'mine')
    assert rejection(panache.learn, model, [(walk, walk)], 5) == 'name: expected a string, found int'
    rejection(panache.learn, model, 5, 'mine')
    styled = panache.stylize(model, walk, {'old': 1})
    assert panache.learn(model, iter([(walk, styled)]), 'mine').model.styles == [*model.styles, 'mine']
    file_skeleton = panache.MotionFile(walk_file).skeleton
    assert rejection(file_skeleton, 'walk') == "clip: expected a whole number, found 'walk'"
    for styles in (['old'], 'old', 1, None):
        assert rejection(panache.stylize, model, walk, styles).startswith(
            'styles: expected a dict of names and numbers, found')
    rejection(panache.stylize_file, walk_file, '/nowhere/o.bvh', 'old')
    rejection(panache.stylize, model, walk, {'old': 1}, shape=['legs'])
    for option in ('max_speed', 'ease_seconds', 'hold_feet', 'timing'):
        text = rejection(panache.stylize, model, walk, {'old': 1}, **{option: 'x'})
        assert text.startswith(f'{option}: expected'), text
    rejection(panache.Character, model, walk.skeleton, max_lag=[])
    for joint in ('LeftHand', 1.5, np.nan):
        assert rejection(file_skeleton, human_joints={'leftHand': joint}) == \
            f"leftHand: expected a whole number, found '{joint}'"
    assert rejection(character.step, 'soon') == "seconds: expected a number, found 'soon'"
    character.step(np.float32(0.1))
    file = panache.MotionFile(walk_file)
    assert rejection(file.clip, 'jump') == \
        f"{walk_file}: holds one motion, which has no name; expected 0, found 'jump'"
    for which in (-1, 1, -2):
        assert rejection(file.clip, which) == \
            f'{walk_file}: there is no motion {which}; it has 1, from 0'
        rejection(panache.read, walk_file, which)
    rejection(file.clip, 0.5)
    monkeypatch.setattr(panache.model, '_MODELS', pathlib.Path('/nowhere'))
    assert rejection(panache.Model).endswith('the shipped models are missing')


def with_list(model, key, lines):
    """The model with a list of its own in its metadata."""
    size = int.from_bytes(model.content[:8], 'little')
    header = json.loads(model.content[8:8 + size])
    header['__metadata__'][key] = ''.join(line + '\n' for line in lines)
    text = json.dumps(header).encode()
    text += b' ' * (-len(text) % 8)
    return panache.Model(len(text).to_bytes(8, 'little') + text + model.content[8 + size:])


def test_styles_have_the_groups_of_the_model(model):
    groups = [f'gröup {i // 2}' for i in range(len(model.styles))]
    assert with_list(model, 'style_groups', groups).groups == groups


def test_styles_have_sides(model, walk):
    sides = ['right leg' if style == 'old' else '' for style in model.styles]
    model = with_list(model, 'style_sides', sides)
    assert model.sides == sides

    def clip(side):
        return panache.stylize(model, walk, {'old': 1}, sides={'Old': side}).rotations.tobytes()

    captured, mirrored = clip(1), clip('left')
    assert captured == panache.stylize(model, walk, {'old': 1}).rotations.tobytes() != mirrored
    assert clip('right') == clip('captured') == captured
    assert clip('mirrored') == clip(-1) == mirrored

    def steps(*sides):
        character = panache.Character(model, walk.skeleton)
        character.set_strength('old', 1)
        for side in sides:
            character.set_side('old', side)
        return [character.stylize(rotations, translations, walk.frame_seconds)[0].tobytes()
                for rotations, translations in zip(walk.rotations, walk.translations)]

    assert steps() == steps('captured') == steps('left', 'right') != steps('left') == steps(-1)
    character = panache.Character(model, walk.skeleton)
    for style, side, message in [
            ('old', 'up', "unknown side 'up' of style 'old'; expected left, right, captured"),
            ('proud', 'left', 'expected captured, mirrored or a number from -1 to 1'),
            ('old', 2, 'side of old: expected -1 to 1, found 2'),
            ('old', None, "side of old: expected a number, found 'None'"),
            ('olld', 1, "unknown style 'olld'")]:
        with pytest.raises(panache.PanacheError, match=message):
            character.set_side(style, side)
        with pytest.raises(panache.PanacheError, match=message):
            panache.stylize(model, walk, {'old': 1}, sides={style: side})


def test_persons_come_by_seed_word_or_numbers(model, walk):
    assert 'stride' in model.person_axes
    numbers = model.person('mara')
    assert numbers.shape == (len(model.person_axes),) and numbers.any()
    assert np.array_equal(model.person('mara', 0.5), numbers * np.float32(0.5))
    assert not np.array_equal(model.person(7), model.person(8))

    def clip(who, **options):
        return panache.stylize(model, walk, {}, person=who, **options).rotations.tobytes()

    plain = walk.rotations.astype(np.float32).tobytes()
    assert clip(None) == clip('mara', variety=0) == plain != clip('mara')
    assert clip('mara') == clip(numbers) != clip(7)

    def steps(*people):
        character = panache.Character(model, walk.skeleton)
        for who in people:
            character.set_person(who)
        return [character.stylize(rotations, translations, walk.frame_seconds)[0].tobytes()
                for rotations, translations in zip(walk.rotations, walk.translations)]

    assert steps() == steps(None) == steps('mara', None) != steps('mara') == steps(numbers)
    for who, message in [(-1, 'person: expected a seed of 0 to 4294967295, found -1'),
                         (np.zeros(3), 'person: expected an array of shape')]:
        with pytest.raises(panache.PanacheError, match=message):
            panache.stylize(model, walk, {}, person=who)


def test_energy_is_an_amount_of_the_shape(model, walk):
    def clip(energy):
        return panache.stylize(model, walk, {}, shape={'energy': energy}).rotations.tobytes()

    assert clip(1) == walk.rotations.astype(np.float32).tobytes() != clip(0.4) != clip(1.6)


def test_gestures_are_listed_triggered_and_thrown_in(model, walk):
    assert len(model.gestures['scared']) > 0 and model.gestures['robot'] == []
    assert set(model.gestures) == set(model.styles)

    def steps(ask=None, **options):
        character = panache.Character(model, walk.skeleton, **options)
        character.set_strength('scared', 1)
        if ask is not None:
            character.trigger('scared', ask)
        return [character.stylize(rotations, translations, walk.frame_seconds)[0].tobytes()
                for rotations, translations in zip(walk.rotations, walk.translations)]

    assert steps(gesture_rate=0) == steps(gesture_rate=0) != steps(ask=1, gesture_rate=0)
    model = with_list(model, 'style_gesture_rates',
                      ['1' if style == 'scared' else '' for style in model.styles])
    assert steps() == steps() == steps(gesture_rate=1) != steps(gesture_seed=5)
    assert steps() != steps(gesture_rate=0)
    with pytest.raises(panache.PanacheError, match="style 'robot' has no gesture 0; it has 0"):
        panache.Character(model, walk.skeleton).trigger('robot')
    with pytest.raises(panache.PanacheError, match='gesture rate of'):
        panache.Character(model, walk.skeleton, gesture_rate=-1)
    plain = panache.stylize(model, walk, {'scared': 1}, loop='off', gesture_rate=0)
    some = panache.stylize(model, walk, {'scared': 1}, loop='off')
    assert plain.rotations.tobytes() != some.rotations.tobytes()


def test_styles_are_found_in_any_case(model, walk):
    assert model.find_style('OLD') == model.find_style('old') == model.find_style('Old')
    assert panache.stylize(model, walk, {'Old': 1}).rotations.tobytes() == \
        panache.stylize(model, walk, {'old': 1}).rotations.tobytes()


def test_names_and_paths_of_any_bytes_reach_python(walk_file, tmp_path):
    def path_of(name):
        return os.fsdecode(os.fsencode(tmp_path) + b'/' + name)
    walk = path_of(b'w\xfclk.bvh')
    text = walk_file.read_bytes()
    root = text.split(b'ROOT ', 1)[1].split()[0]
    pathlib.Path(walk).write_bytes(text.replace(b'ROOT ' + root, b'ROOT ' + root + b'\xfc', 1))
    for path in (walk, pathlib.Path(walk)):
        file = panache.MotionFile(path)
        assert len(file.clip()) == 240
        assert file.joint_names[0] == root.decode() + '\ufffd'
    panache.stylize_file(walk, path_of(b'\xe4.bvh'), {'old': 1})
    assert b'ROOT ' + root + b'\xfc' in pathlib.Path(path_of(b'\xe4.bvh')).read_bytes()
    rod = path_of(b'r\xf6d.bvh')
    pathlib.Path(rod).write_bytes(
        b'HIERARCHY\nROOT a\xfc\n{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\nEnd Site\n{\n'
        b'OFFSET 0 1 0\n}\n}\nMOTION\nFrames: 1\nFrame Time: 0.1\n0\n')
    assert 'r\ufffdd.bvh: ' in panache.info(rod)['error']


def test_memory_of_the_library_outlives_what_made_it(model, walk_file):
    rotations = panache.stylize(model, panache.read(walk_file), {'old': 1}).rotations
    before = rotations.tobytes()
    for _ in range(20):
        panache.stylize(model, panache.read(walk_file), {'moping': 1})
    assert rotations.tobytes() == before


def test_the_code_of_the_page_runs(walk_file, run, tmp_path, monkeypatch):
    """Its blocks in their order, as in one notebook; what is after '# ->' is what a line gives."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / 'walk.bvh').write_bytes(walk_file.read_bytes())
    run('convert', walk_file, '-o', 'hero.glb')
    text = pathlib.Path(os.environ['PANACHE_PAGE']).read_text()
    blocks = [part.split('```')[0] for part in text.split('```python\n')[1:]]
    assert len(blocks) >= 6
    names = {}
    for block in blocks:
        exec(compile(block, 'docs/python.md', 'exec'), names)
        for line in block.split('\n'):
            if '  # -> ' in line:
                code, expected = line.split('  # -> ')
                assert repr(eval(code, names)) == expected.strip(), line


def test_an_error_has_a_kind():
    with pytest.raises(panache.PanacheError) as raised:
        panache.Model(__file__)
    assert raised.value.kind == 'not_safetensors'

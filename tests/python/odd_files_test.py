"""Files that are odd and can be used all the same: wrong rates and counts, animations beside the
body."""

import re
import warnings

import numpy as np
import pytest

import panache
from lamp import write_lamps


@pytest.fixture
def rewrite(walk_file, tmp_path):
    """Writes the walk with another line in it."""
    def rewrite(name, line):
        text, count = re.subn(line.split(':')[0] + ':.*', line, walk_file.read_text())
        assert count == 1
        (tmp_path / name).write_text(text)
        return tmp_path / name
    return rewrite


@pytest.fixture
def lamps(walk_file, run, tmp_path):
    """A file with an animation of a lamp before the walk, and one with that alone."""
    lit, lamp = tmp_path / 'lit.glb', tmp_path / 'lamp.glb'
    run('convert', walk_file, '-o', tmp_path / 'walk.glb')
    write_lamps(tmp_path / 'walk.glb', lit, lamp)
    return lit, lamp


def test_a_file_is_read_and_written_at_a_given_rate(rewrite, shipped, run, tmp_path):
    zero = rewrite('zero.bvh', 'Frame Time: 0')
    for use in (panache.MotionFile, panache.read, panache.info):
        with pytest.raises(panache.PanacheError, match=r'zero.bvh:\d+:\d+: .*give its rate$'):
            use(zero)
    file = panache.MotionFile(zero, fps=50)
    assert file.clip().frame_seconds == 1 / 50 and file.notes == []
    assert panache.read(zero, fps=50).frame_seconds == 1 / 50
    assert panache.info(zero, fps=50)['clips'][0]['seconds'] == pytest.approx(240 / 50)
    a, b = tmp_path / 'a.bvh', tmp_path / 'b.bvh'
    panache.stylize_file(zero, a, {'old': 1}, fps=50)
    run('stylize', zero, '--fps', 50, '--model', shipped, '--style', 'old=1', '-o', b)
    assert a.read_bytes() == b.read_bytes() and b'Frame Time: 0.02' in a.read_bytes()
    panache.retarget_file(zero, a, a, fps=50, force=True)
    run('retarget', zero, '--fps', 50, '--onto', b, '-o', b, '--force')
    assert a.read_bytes() == b.read_bytes()


@pytest.mark.parametrize('fps', [0, -30, 1e5, np.nan, np.inf])
def test_a_rate_that_cannot_be_is_rejected(walk_file, fps):
    with pytest.raises(panache.PanacheError, match='expected a rate of 0.01 to 10000 frames'):
        panache.MotionFile(walk_file, fps=fps)


def test_a_wrong_count_is_noted_and_all_rows_are_read(rewrite, walk, tmp_path):
    for count in (3, 9999):
        odd = rewrite(f'{count}.bvh', f'Frames: {count}')
        note, = panache.MotionFile(odd).notes
        assert re.match(rf"{re.escape(str(odd))}:\d+:\d+: expected .*240.*found '{count}'", note)
        with pytest.warns(UserWarning, match=re.escape(note)) as caught:
            clip = panache.read(odd)
        assert caught[0].filename == __file__
        assert np.array_equal(clip.rotations, walk.rotations)
        with pytest.warns(UserWarning, match=re.escape(note)):
            panache.stylize_file(odd, tmp_path / f'{count}-old.bvh', {'old': 1})
        assert panache.MotionFile(tmp_path / f'{count}-old.bvh').notes == []


def test_steps_too_slow_for_the_legs_are_noted(rewrite):
    slow = rewrite('slow.bvh', 'Frame Time: 0.1')
    note, = panache.MotionFile(slow).notes
    assert note.startswith(f'{slow}: expected steps') and note.endswith('give its rate')
    assert panache.MotionFile(slow, fps=60).notes == []


def test_animations_beside_the_body_are_passed_over(lamps, shipped, run, tmp_path):
    lit, lamp = lamps
    passed_over = f"{lit}: 'lamp' moves no joint of the humanoid and is passed over"
    file = panache.MotionFile(lit)
    assert file.clip_names == ['lamp', 'walk'] and file.moves == [False, True]
    assert file.notes == [passed_over]
    assert [clip['moves'] for clip in panache.info(lit)['clips']] == [False, True]
    with pytest.warns(UserWarning, match=re.escape(passed_over)):
        assert np.array_equal(panache.read(lit).rotations, file.clip('walk').rotations)
    with warnings.catch_warnings():  # Who asks for it by name gets it.
        warnings.simplefilter('error')
        assert len(panache.read(lit, 'lamp')) == len(file.clip('lamp'))
    a, b = tmp_path / 'a.glb', tmp_path / 'b.glb'
    for mode, option in (('first', []), ('last', ['--last']), ('replace', ['--replace'])):
        with pytest.warns(UserWarning, match=re.escape(passed_over)):
            panache.stylize_file(lit, a, {'old': 1}, mode=mode, force=True)
        run('stylize', lit, '--model', shipped, '--style', 'old=1', *option, '-o', b, '--force')
        assert a.read_bytes() == b.read_bytes()
    with pytest.warns(UserWarning, match=re.escape(passed_over)):
        panache.retarget_file(lit, lamp, a, force=True)
    run('retarget', lit, '--onto', lamp, '-o', b, '--force')
    assert a.read_bytes() == b.read_bytes()


def test_a_file_without_motion_of_the_body_is_rejected(lamps, tmp_path):
    _, lamp = lamps
    expected = 'lamp.glb: none of its motions moves a joint of the humanoid; expected an animation'
    for use in (lambda: panache.read(lamp),
                lambda: panache.stylize_file(lamp, tmp_path / 'o.glb', {'old': 1}),
                lambda: panache.retarget_file(lamp, lamp, tmp_path / 'o.glb')):
        with pytest.raises(panache.PanacheError, match=expected):
            use()
    assert not (tmp_path / 'o.glb').exists()

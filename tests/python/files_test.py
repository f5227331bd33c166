"""Files are written whole or not at all, and nothing of the user's is lost on the way."""

import os
import stat
import threading

import pytest

import panache


def test_no_other_file_is_touched(model, tmp_path):
    target = tmp_path / 'model.safetensors'
    for name in ('model.safetensors.part', f'.model.safetensors.{os.getpid()}.part'):
        (tmp_path / name).write_text('theirs')
    before = sorted(os.listdir(tmp_path))
    model.save(target)
    model.save(target, force=True)
    assert sorted(os.listdir(tmp_path)) == sorted(before + [target.name])
    assert all((tmp_path / name).read_text() == 'theirs' for name in before)


def test_a_replaced_file_keeps_its_permissions_and_its_links(model, tmp_path):
    (tmp_path / 'folder').mkdir()
    target, link = tmp_path / 'folder' / 'a', tmp_path / 'link'
    target.write_text('old')
    target.chmod(0o640)
    link.symlink_to('folder/a')
    model.save(link, force=True)
    assert link.is_symlink() and target.stat().st_size > 1000
    assert stat.S_IMODE(target.stat().st_mode) == 0o640
    (tmp_path / 'to_nothing').symlink_to('folder/b')
    model.save(tmp_path / 'to_nothing')
    assert (tmp_path / 'to_nothing').is_symlink() and (tmp_path / 'folder' / 'b').is_file()
    before = os.umask(0o027)
    model.save(tmp_path / 'new')
    os.umask(before)
    assert stat.S_IMODE((tmp_path / 'new').stat().st_mode) == 0o640


def test_what_is_no_file_is_never_replaced(model, tmp_path):
    (tmp_path / 'folder').mkdir()
    os.mkfifo(tmp_path / 'pipe')
    (tmp_path / 'round').symlink_to('round')
    for name in ('folder', 'pipe', 'round'):
        with pytest.raises(panache.PanacheError, match=f'{name}: (is a|cannot be written: Too many)'):
            model.save(tmp_path / name, force=True)
    assert sorted(os.listdir(tmp_path)) == ['folder', 'pipe', 'round']
    assert stat.S_ISFIFO((tmp_path / 'pipe').stat().st_mode)


def test_of_many_writers_one_wins_unless_they_may_overwrite(model, tmp_path):
    for force in (False, True):
        outcomes = []

        def save():
            try:
                model.save(tmp_path / f'a{force}', force=force)
                outcomes.append('')
            except panache.PanacheError as error:
                outcomes.append(str(error).split(': ')[1])
        threads = [threading.Thread(target=save) for _ in range(8)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        expected = [''] * 8 if force else [''] + ['exists already; force=True overwrites it'] * 7
        assert sorted(outcomes) == expected
    assert sorted(os.listdir(tmp_path)) == ['aFalse', 'aTrue']


def test_a_name_may_be_as_long_as_the_system_allows(model, tmp_path):
    model.save(tmp_path / ('a' * 255))
    model.save(tmp_path / ('a' + 'ä' * 127))
    assert sorted(map(len, os.listdir(tmp_path))) == [128, 255]

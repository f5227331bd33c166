"""What the tests share. They see the installed package alone."""

import os
import subprocess

import numpy as np
import pytest

import panache


@pytest.fixture(scope='session')
def model():
    return panache.Model()


@pytest.fixture(scope='session')
def run():
    """Runs the program."""
    def run(*arguments):
        return subprocess.run([os.environ['PANACHE_PROGRAM'], *map(str, arguments)], check=True,
                              capture_output=True, text=True).stdout
    return run


@pytest.fixture(scope='session')
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp('motion')


@pytest.fixture(scope='session')
def walk_file(folder, run):
    run('walker', '-o', folder / 'walk.bvh', '--seconds', 4, '--turn', 15)
    return folder / 'walk.bvh'


@pytest.fixture(scope='session')
def shipped(model, folder):
    """The default model as a file, for the program."""
    model.save(folder / 'model.safetensors')
    return folder / 'model.safetensors'


@pytest.fixture
def walk(walk_file):
    return panache.read(walk_file)


def angles(a, b):
    """Between rotations, radians."""
    return 2 * np.arccos(np.minimum(1, np.abs((a * b).sum(-1))))

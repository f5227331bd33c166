"""The sample for PyTorch. Skipped without torch."""

import importlib.util
import os
import re
import subprocess
import sys

import numpy as np
import pytest

import panache

torch = pytest.importorskip('torch')
SAMPLE = os.path.join(os.environ['PANACHE_SAMPLES'], 'torch', 'train.py')


@pytest.fixture(scope='module')
def sample():
    spec = importlib.util.spec_from_file_location('train', SAMPLE)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_sample_learns_from_workers(walk_file):
    out = subprocess.run([sys.executable, SAMPLE, walk_file], check=True, capture_output=True,
                         text=True, timeout=900).stdout
    nothing, network = map(float, re.findall(r'are ([0-9.]+) cm', out))
    assert network < nothing / 3, out


def test_a_change_on_a_pose_is_a_pose_of_the_styled_clip(sample, model, walk):
    styled = panache.stylize(model, walk, {'old': 1}, timing='off', hold_feet=False)
    pairs = panache.training_samples((walk, styled))
    poses = panache.training_samples(styled).windows[:, :63].reshape(-1, 21, 3)
    windows, changes = torch.tensor(np.array(pairs.windows)), torch.tensor(np.array(pairs.changes))

    def apart(changes):
        """Of each pose from the nearest of the styled clip: samples are laid together in time."""
        made = sample.changed_positions(windows, changes).numpy()[10:]
        distances = np.linalg.norm(made[:, None] - poses[None], axis=-1).mean(-1)
        return distances.min(1).mean()

    unchanged, changed = apart(torch.zeros_like(changes)), apart(changes)
    print(f'{100 * changed:.2f} cm apart, unchanged {100 * unchanged:.2f} cm')
    assert changed < 0.03 and unchanged > 0.1  # Between samples, 1/30 s, a foot moves by about 5 cm.

"""A torch Dataset of motion that worker processes restyle, a small network trained on it, and its
change as joint positions. See README.md."""

import sys

import numpy as np
import panache
import torch
from torch.utils.data import DataLoader, Dataset

# Of the 21 canonical joints: hips, spine, ... (docs/conventions.md).
PARENTS = [-1, 0, 1, 2, 3, 2, 5, 6, 7, 2, 9, 10, 11, 0, 13, 14, 15, 0, 17, 18, 19]


class Restyled(Dataset):
    """Item i: windows [n, 396] of a clip, and what style i does there, changes [n, 67]."""

    def __init__(self, model, clip, styles):
        self.model, self.clip, self.styles = model, clip, styles  # Pickled for each worker.

    def __len__(self):
        return len(self.styles)

    def __getitem__(self, i):
        styled = panache.stylize(self.model, self.clip, {self.styles[i]: 1})
        samples = panache.training_samples((self.clip, styled))
        return torch.tensor(np.array(samples.windows)), torch.tensor(np.array(samples.changes))


def changed_positions(windows, changes):
    """The newest pose of each window with the change on it: [n, 21, 3], metres, body frame.

    Each bone turns by the rotation of the joint that it starts at, and the hips are raised."""
    positions = windows[:, :63].reshape(-1, 21, 3)
    x, y, z = changes[:, :63].reshape(-1, 21, 3).unbind(-1)
    zero = torch.zeros_like(x)
    turns = torch.matrix_exp(torch.stack(
        [zero, -z, y, z, zero, -x, -y, x, zero], -1).reshape(-1, 21, 3, 3))
    up = torch.stack([zero[:, 0], changes[:, 63], zero[:, 0]], -1)
    out = [positions[:, 0] + up]
    for j in range(1, 21):
        bone = positions[:, j] - positions[:, PARENTS[j]]
        out.append(out[PARENTS[j]] + (turns[:, PARENTS[j]] @ bone[..., None])[..., 0])
    return torch.stack(out, 1)


def main(path):
    torch.manual_seed(1)
    data = Restyled(panache.Model(), panache.read(path), ['old', 'old', 'old', 'old'])
    loader = DataLoader(data, batch_size=None, num_workers=2, multiprocessing_context='spawn')
    network = torch.nn.Sequential(torch.nn.Linear(396, 64), torch.nn.ELU(), torch.nn.Linear(64, 67))
    optimiser = torch.optim.Adam(network.parameters(), lr=3e-3)
    for windows, changes in loader:
        for _ in range(50):
            error = torch.nn.functional.mse_loss(network(windows), changes)
            optimiser.zero_grad()
            error.backward()
            optimiser.step()
    with torch.no_grad():
        wanted = changed_positions(windows, changes)
        for name, change in (('nothing', torch.zeros_like(changes)), ('the network', network(windows))):
            apart = (changed_positions(windows, change) - wanted).norm(dim=-1).mean()
            print(f'{name}: joints are {100 * apart:.1f} cm from the style')


if __name__ == '__main__':
    main(sys.argv[1])

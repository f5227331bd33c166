"""Learns new styles, and makes samples for your own training."""

import ctypes
import os
from ctypes import byref, c_size_t
from dataclasses import dataclass
from typing import Iterable, List, Optional, Sequence, Tuple, Union

import numpy as np

from . import _library as c
from ._interface import CHANGE_SIZE, WINDOW_SIZE
from ._library import Handle, PanacheError, check, lib, sized, utf8
from .clips import Clip
from .files import Path, read
from .model import NEUTRAL_BANK, Model

ClipOrPath = Union[Clip, Path]


@dataclass
class Learnt:
    """A model with a newly learnt style, and its quality.

    warnings: messages about the clips.
    held_back_cm, mean_posture_cm, untouched_cm: mean joint distance on the last quarters of the
              styled clips, held back from a trial, on a body of 1.6 metres: with the style,
              with only its mean posture, and of the neutral motion; None if clips are too short.
    verdict:  from these distances: 'good'; 'fair' if the style reduces the distance little, or less
              than its mean posture does; 'poor' if it is no better than the neutral motion; None if
              the clips are too short.
    people:   for a style learnt from one clip: the number of people whose mean motion replaces the
              neutral clip; None for pairs.
    certainty: likewise, the share of the difference in posture that counts as style, 0 to 1; the
              rest is variation between people, or unknown.
    """
    model: Model
    warnings: List[str]
    held_back_cm: Optional[float]
    mean_posture_cm: Optional[float]
    untouched_cm: Optional[float]
    verdict: Optional[str]
    people: Optional[int] = None
    certainty: Optional[float] = None


@dataclass
class Samples:
    """Training data of the networks of recipe panache; read-only views, float32.

    windows:   [samples, 396]: 6 poses 0.05 s apart, newest first, of 66 features: 21 joint positions
               in the body frame (m), velocity to the left and ahead (m/s), turn rate (rad/s).
    changes:   [samples, 67]: 21 rotation vectors (rad), height of the hips (m), velocity to the left
               and ahead (m/s), turn rate (rad/s).
    log_rates: [samples], logarithm of neutral seconds per styled second.
    contacts:  [samples, 2], 1 where the left and the right foot of the styled clip are planted.
    """
    windows: np.ndarray
    changes: np.ndarray
    log_rates: np.ndarray
    contacts: np.ndarray

    def __len__(self) -> int:
        return len(self.windows)


def _clip(source: ClipOrPath) -> Clip:
    if isinstance(source, Clip):
        return source
    if not isinstance(source, (str, os.PathLike)):
        raise PanacheError(f'expected a Clip or a path, found {type(source).__name__}')
    return read(source)


def learn(model: Model, pairs: Union[Sequence[Tuple[ClipOrPath, ClipOrPath]], ClipOrPath],
          name: str, replace: bool = False) -> Learnt:
    """Learns the style `name` from pairs (neutral, styled) of the same action: 2 to 3 seconds of a
    walk, or a whole gesture, on skeletons with the same joint names and parents. Each is a clip or
    a path. A single styled clip instead of pairs is compared with the mean motion of other people.
    Does not modify `model`; replaces an existing style of this name only with `replace`."""
    if isinstance(pairs, (Clip, str, os.PathLike)):
        alone, bank = _clip(pairs), NEUTRAL_BANK.read_bytes()
        handle = Handle('learnt', lib.learn_alone, model.content, len(model.content), bank,
                        len(bank), alone._struct(), utf8(name, 'name'), bool(replace))
    else:
        pairs = list(pairs) if isinstance(pairs, Iterable) else [pairs]
        for pair in pairs:
            if not isinstance(pair, (tuple, list)) or len(pair) != 2:
                raise PanacheError('pairs: expected (neutral, styled) each, of clips or paths')
        clips = [(_clip(neutral), _clip(styled)) for neutral, styled in pairs]
        array = (c.structs.Pair * max(len(clips), 1))(*[(a._struct(), b._struct()) for a, b in clips])
        handle = Handle('learnt', lib.learn, model.content, len(model.content), array, len(clips),
                        utf8(name, 'name'), bool(replace))
    size = c_size_t()
    data = lib.learnt_model(handle.pointer, byref(size))
    report = sized(c.structs.LearntReport)
    check(lib.learnt_get_report(handle.pointer, report))
    distances = [report.held_back_cm, report.mean_posture_cm, report.untouched_cm]
    return Learnt(Model(ctypes.string_at(data, size.value)),
                  (report.warnings or b'').decode().splitlines(),
                  *(distances if report.was_tested else [None] * 3),
                  lib.learnt_verdict(handle.pointer).decode() or None,
                  *([report.people, report.certainty] if report.people else [None] * 2))


def training_samples(*sources: Union[ClipOrPath, Tuple[ClipOrPath, ClipOrPath]]) -> Samples:
    """The samples of clips or files, 30 per second, in order of the sources. A pair (neutral,
    styled) gives, for each instant of the styled clip, the window of the neutral clip and the
    change by the style; a single clip gives its windows with changes of 0."""
    pairs = [source if isinstance(source, tuple) else (source, None) for source in sources]
    clips = [(_clip(a), None if b is None else _clip(b)) for a, b in pairs]
    array = (c.structs.Pair * max(len(clips), 1))(
        *[(a._struct(), c.structs.Clip() if b is None else b._struct()) for a, b in clips])
    handle = Handle('samples', lib.samples_create, array, len(clips))
    at, count = handle.pointer, lib.samples_count(handle.pointer)
    return Samples(handle.view(lib.samples_windows(at), (count, WINDOW_SIZE)),
                   handle.view(lib.samples_changes(at), (count, CHANGE_SIZE)),
                   handle.view(lib.samples_log_rates(at), (count,)),
                   handle.view(lib.samples_contacts(at), (count, 2)))

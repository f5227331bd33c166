"""Live characters: one step per frame."""

import ctypes
import os
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Optional, Sequence, Tuple, Union

import numpy as np

from . import _library as c
from ._library import Handle, PanacheError, check, fixed, floats, lib, number, sized
from .clips import Skeleton
from .model import Model


@dataclass
class Report:
    """The state after the last step.

    gate:     1: motion like the training data; 0: unlike it, so only the style's mean is used.
    contacts: probability that the left and the right foot are planted.
    rate:     the style's tempo, as seconds of input per second, 0.5 to 2.
    ahead:    seconds by which the output leads the newest input; negative if it lags.
    """
    gate: float
    contacts: Tuple[float, float]
    rate: float
    ahead: float


class Character:
    """One moving character.

        character.set_strength('old', 1)
        each frame:
            character.input_rotations[:] = ...
            character.input_translations[:] = ...
            character.step(1 / 60)
            use(character.rotations, character.translations)

    These arrays belong to the character and never move: float32, rotations [joints, 4] and
    translations [joints, 3]. Assigning an array to an input copies it; outputs cannot be assigned.
    In the library, a step does not allocate memory.

    ease_seconds:      approximate duration of a change of strength; 0 to 10.
    smoothing_seconds: time constant of the filter on a style's changes; 0 to 10.
    hold_feet:         keeps planted feet in place.
    style_root:        stylizes root motion, too.
    max_lag, max_lead: seconds that a style's own tempo may lag (up to 4) or lead (up to 0.25) the
                       input; if both are 0, the output keeps the input's tempo.
    max_speed:         m/s; faster hips count as a jump, which restarts the style. Characters on
                       vehicles need more; 0 or infinity disables this.
    gesture_rate:      how often the active styles play their gestures, at random: 1 as often as
                       the performers did, 0 not at all, up to 10 times as often.
    gesture_seed:      different seeds make characters gesture at different times.
    skip_cycles:       skips or repeats whole gait cycles to stay within max_lag and max_lead.
    """

    def __init__(self, model: Model, skeleton: Skeleton, *, ease_seconds: float = 0.15,
                 smoothing_seconds: float = 0.04, hold_feet: bool = True, style_root: bool = True,
                 skip_cycles: bool = False, max_lag: float = 0, max_lead: float = 0,
                 max_speed: float = 15, remover: Optional[Model] = None, gesture_rate: float = 1,
                 gesture_seed: int = 0):
        self.model, self.skeleton, self.remover = model, skeleton, remover
        options = sized(c.structs.CharacterOptions, ease_seconds=ease_seconds,
                        smoothing_seconds=smoothing_seconds, hold_feet=hold_feet,
                        style_root=style_root, skip_cycles=skip_cycles, max_lag=max_lag,
                        max_lead=max_lead, max_speed=max_speed, gesture_rate=gesture_rate,
                        gesture_seed=gesture_seed)
        if remover is not None:
            options.remover = remover._handle.pointer
        self._handle = Handle('character', lib.character_create, model._handle.pointer,
                              skeleton._handle.pointer, options)
        self._pointer = self._handle.pointer
        joints = len(skeleton)
        self._input_rotations = fixed((joints, 4))
        self._input_rotations[:, 3] = 1
        self._input_translations = fixed((joints, 3))
        self._rotations, self._translations = fixed((joints, 4)), fixed((joints, 3))
        self._rotations[:, 3] = 1
        # Created once, so that a step adds only one call to the library's own time.
        self._in = c.structs.InputPose(self._input_rotations.ctypes.data, self._input_translations.ctypes.data)
        self._out = c.structs.OutputPose(self._rotations.ctypes.data, self._translations.ctypes.data)
        self._step = lib.character_step

    @property
    def input_rotations(self) -> np.ndarray:
        """[joints, 4], the input of the next step."""
        return self._input_rotations

    @input_rotations.setter
    def input_rotations(self, rotations: np.ndarray) -> None:
        self._input_rotations[:] = floats(rotations, self._input_rotations.shape, 'rotations')

    @property
    def input_translations(self) -> np.ndarray:
        """[joints, 3], likewise."""
        return self._input_translations

    @input_translations.setter
    def input_translations(self, translations: np.ndarray) -> None:
        self._input_translations[:] = floats(translations, self._input_translations.shape,
                                             'translations')

    @property
    def rotations(self) -> np.ndarray:
        """[joints, 4], the output of the last step."""
        return self._rotations

    @property
    def translations(self) -> np.ndarray:
        """[joints, 3], likewise."""
        return self._translations

    def step(self, seconds: float) -> None:
        """Stylizes the pose in `input_rotations` and `input_translations` into `rotations` and
        `translations`; `seconds`: the time since the last step. Cannot fail: non-finite numbers
        are replaced by the last valid pose."""
        try:
            self._step(self._pointer, self._in, seconds, self._out)
        except ctypes.ArgumentError:
            self._step(self._pointer, self._in, number(seconds, 'seconds'), self._out)

    def stylize(self, rotations: np.ndarray, translations: np.ndarray,
                seconds: float) -> Tuple[np.ndarray, np.ndarray]:
        """The same for a pose in other arrays, [joints, 4] and [joints, 3]: copies them, and
        returns copies of the result."""
        self.input_rotations, self.input_translations = rotations, translations
        self.step(seconds)
        return self.rotations.copy(), self.translations.copy()

    def set_strength(self, style: str, strength: float) -> None:
        """Sets the strength of a style: 0 is off, 1 as captured; -4 to 4. The change is eased."""
        lib.character_set_strength(self._pointer, self.model.find_style(style),
                                   number(strength, style))

    def set_side(self, style: str, side: Union[float, str]) -> None:
        """Sets the side of a style: 1 or 'captured', -1 or 'mirrored', a number between, or 'left'
        or 'right' if `model.sides` says which was captured. The change is eased."""
        lib.character_set_side(self._pointer, self.model.find_style(style),
                               self.model.find_side(style, side))

    def set_person(self, who: Union[int, str, np.ndarray, None], amount: float = 1) -> None:
        """Makes the character another person, in addition to its styles: see `Model.person()`;
        None: nobody. The change is eased."""
        if who is None:
            who, amount = np.zeros(len(self.model.person_axes), np.float32), 1
        numbers = np.ascontiguousarray(self.model.person(who, amount))
        check(lib.character_set_person_numbers(self._pointer, numbers.ctypes.data, len(numbers)))

    def set_removed(self, style: Optional[str]) -> None:
        """Sets the style that the remover removes from the input; None: no style."""
        if self.remover is None:
            raise PanacheError('set_removed: expected a character that was given a remover')
        removed = self.remover.find_style(style) if style is not None else -1
        lib.character_set_removed(self._pointer, removed)

    def trigger(self, style: str, gesture: int = 0) -> None:
        """Plays one of `model.gestures[style]` at the style's strength, once no other gesture
        plays and a foot is on the floor; gives up waiting after 3 s."""
        place = self.model.find_style(style)
        if not lib.character_trigger(self._pointer, place, c.whole(gesture, 'gesture')):
            raise PanacheError(f'style {style!r} has no gesture {gesture}; it has '
                               f'{len(self.model.gestures[self.model.styles[place]])}')

    def set_shape(self, **amounts: float) -> None:
        """Scales parts of the styles' effect, 0 to 2 each; parts not named are 1:
        `set_shape(posture=0.5, left_arm=0)`. See panache_shape."""
        check(lib.character_set_shape(self._pointer, c.shape_of(amounts)))

    def reset(self) -> None:
        """Resets the motion history; keeps strengths and sides."""
        lib.character_reset(self._pointer)

    def report(self) -> Report:
        report = sized(c.structs.Report)
        check(lib.character_get_report(self._pointer, report))
        return Report(report.gate, tuple(report.contacts), report.rate, report.ahead)

    def save(self) -> bytes:
        """The character's state for `restore()`: to be kept in memory, not in files."""
        state = ctypes.create_string_buffer(lib.character_state_size(self._pointer))
        lib.character_save(self._pointer, state)
        return state.raw

    def restore(self, state: bytes) -> None:
        """Restores the state of a character with the same model, skeleton and options; it
        continues bit for bit."""
        check(lib.character_restore(self._pointer, state, len(state)))


class Crowd:
    """Characters that are stepped together, which is faster if they share a model. Each gives the
    same result as alone, bit for bit. No character may be listed twice.

    threads: number of threads, 1 to 256; 0: one per core that this process may use.
    """

    def __init__(self, characters: Sequence[Character], *, threads: int = 1):
        self._characters = tuple(characters)  # The step uses their arrays.
        threads = c.whole(threads, 'threads')
        if not 0 <= threads <= 256:
            raise PanacheError(f'threads: expected 0 to 256, found {threads}')
        threads = min(threads or _cores(), max(len(self._characters), 1))
        bounds = [len(self._characters) * i // threads for i in range(threads + 1)]
        self._parts = [_part(self._characters[begin:end]) for begin, end in zip(bounds, bounds[1:])]
        self._pool, self._pool_of = None, 0

    @property
    def characters(self) -> Tuple[Character, ...]:
        return self._characters

    @property
    def threads(self) -> int:
        return len(self._parts)

    def step(self, seconds: float) -> None:
        """`Character.step()` for all."""
        seconds = number(seconds, 'seconds')
        if len(self._parts) == 1:
            return _step_part(self._parts[0], seconds)
        if self._pool_of != os.getpid():  # A fork does not inherit threads.
            self._pool = ThreadPoolExecutor(len(self._parts) - 1)
            self._pool_of = os.getpid()
        others = [self._pool.submit(_step_part, part, seconds) for part in self._parts[1:]]
        _step_part(self._parts[0], seconds)
        for other in others:
            other.result()


def _cores() -> int:
    """The number of cores that this process may use."""
    if hasattr(os, 'sched_getaffinity'):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def _part(characters):
    """The arguments of panache_step_many() except the seconds."""
    count = len(characters)
    return ((ctypes.c_void_p * count)(*[one._pointer.value for one in characters]), count,
            (c.structs.InputPose * count)(*[one._in for one in characters]),
            (c.structs.OutputPose * count)(*[one._out for one in characters]))


def _step_part(part, seconds: float) -> None:
    handles, count, poses_in, poses_out = part
    lib.step_many(handles, count, poses_in, seconds, poses_out)

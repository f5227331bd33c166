"""Skeletons, clips, and operations on whole clips."""

import ctypes
from dataclasses import dataclass
from typing import Dict, Mapping, Optional, Sequence, Tuple, Union

import numpy as np

from . import _library as c
from ._library import Handle, PanacheError, check, floats, lib, mapping, number, sized, utf8
from .model import Model

HUMAN_JOINTS = ('hips', 'spine', 'chest', 'neck', 'head') + tuple(
    side + joint for side in ('left', 'right')
    for joint in ('Shoulder', 'UpperArm', 'LowerArm', 'Hand', 'UpperLeg', 'LowerLeg', 'Foot',
                  'Toes'))
Strength = Union[float, Sequence[Tuple[float, float]]]
_REMOVER, _ANY = 'remover-int8', 'any'  # The shipped remover, and its entry for other styles.
_LOOPS = ('off', 'auto', 'on')
_TIMINGS = ('off', 'steps', 'all')  # In the order of panache_stylize_options.style_timing.


class Skeleton:
    """A rig and its mapping to a humanoid. Immutable; any number of characters and clips may
    share it.

    names:         joint names, parents before children.
    parents:       [joints], the index of each joint's parent, smaller than its own; -1 for a root.
    rotations:     [joints, 4], at rest, relative to the parent.
    translations:  [joints, 3], likewise, in the units of the rig.
    poses:         a few poses of typical motion, (rotations [n, joints, 4], translations
                   [n, joints, 3]); they show axes, floor and sides better than the rest pose.
    metres_per_unit, up_axis: override the detected values: 0.01, '+Z'.
    human_joints:  {'leftHand': index, ...}: overrides detected joints, by VRM 1.0 names; -1 means
                   that the rig has none.
    """

    def __init__(self, names: Sequence[str], parents: Sequence[int], rotations: np.ndarray,
                 translations: np.ndarray, *,
                 poses: Optional[Tuple[np.ndarray, np.ndarray]] = None,
                 metres_per_unit: float = 0, up_axis: Optional[str] = None,
                 human_joints: Optional[Mapping[str, int]] = None):
        count = len(names)
        if len(parents) != count:
            raise PanacheError(f'parents: expected {count}, as many as names, found '
                               f'{len(parents)}')
        rotations = floats(rotations, (count, 4), 'rotations')
        translations = floats(translations, (count, 3), 'translations')
        told = {'metres_per_unit': metres_per_unit, 'up_axis': up_axis,
                'human_joints': dict(mapping(human_joints or {}, 'human_joints'))}
        made_of = [list(names), [int(parent) for parent in parents], rotations.copy(),
                   translations.copy()]
        array = (c.structs.Joint * max(count, 1))()
        for j, name in enumerate(names):
            array[j].name, array[j].parent = utf8(name, 'joint'), int(parents[j])
            array[j].rotation[:] = rotations[j].tolist()
            array[j].translation[:] = translations[j].tolist()
        options, kept = _options(metres_per_unit, up_axis, human_joints)
        if poses is not None:
            turns = floats(poses[0], (None, count, 4), 'poses, rotations')
            moves = floats(poses[1], (len(turns), count, 3), 'poses, translations')
            kept += [turns, moves]
            options.rotations, options.translations = turns.ctypes.data, moves.ctypes.data
            options.pose_count = len(turns)
            told['poses'] = (turns.copy(), moves.copy())
        self._adopt(Handle('skeleton', lib.skeleton_create, array, count, options), names, parents,
                    (_skeleton_again, (made_of, told)))

    def _adopt(self, handle: Handle, names, parents, again) -> 'Skeleton':
        """`again`: a function and its arguments that recreate this skeleton in another process."""
        self._handle = handle
        self.joint_names = list(names)
        self.parents = [int(parent) for parent in parents]
        self._again = again
        return self

    def __reduce__(self):
        return self._again

    def __len__(self) -> int:
        return len(self.joint_names)

    def __repr__(self) -> str:
        return f'<panache.Skeleton of {len(self)} joints>'

    def find(self, human_joint: str) -> int:
        """The index of the joint mapped to this human joint ('leftHand'), or -1."""
        return lib.skeleton_find(self._handle.pointer, utf8(human_joint, 'human joint'))

    def mapping(self) -> Dict[str, Optional[str]]:
        """The rig's joint name for each human joint, or None."""
        places = {human: self.find(human) for human in HUMAN_JOINTS}
        return {human: self.joint_names[j] if j >= 0 else None for human, j in places.items()}


def _skeleton_again(made_of, told) -> Skeleton:
    return Skeleton(*made_of, **told)


def _options(metres_per_unit=0.0, up_axis=None, human_joints=None):
    """The struct, and the objects that it points to."""
    human = [c.structs.HumanJoint(utf8(name, 'human joint'), c.whole(joint, name))
             for name, joint in mapping(human_joints or {}, 'human_joints').items()]
    array = (c.structs.HumanJoint * max(len(human), 1))(*human)
    options = sized(c.structs.SkeletonOptions, metres_per_unit=metres_per_unit,
                    up_axis=utf8(up_axis, 'up_axis') if up_axis else None, human_joint_count=len(human),
                    human_joints=array)
    return options, [array]


@dataclass(frozen=True, eq=False)
class Clip:
    """Motion of a rig at a constant rate.

    rotations:     float32 [frames, joints, 4], unit, x y z w, relative to the parent.
    translations:  float32 [frames, joints, 3], relative to the parent, in the rig's units.
    frame_seconds: time between frames.

    Contiguous float32 arrays are not copied, others are converted. Arrays cannot be reassigned;
    `dataclasses.replace(clip, translations=...)` makes a new clip.
    """
    skeleton: Skeleton
    rotations: np.ndarray
    translations: np.ndarray
    frame_seconds: float

    def __post_init__(self):
        joints = len(self.skeleton)
        set_once = object.__setattr__
        set_once(self, 'rotations', floats(self.rotations, (None, joints, 4), 'rotations'))
        set_once(self, 'translations', floats(self.translations, (len(self.rotations), joints, 3),
                                              'translations'))

    def __len__(self) -> int:
        return len(self.rotations)

    @property
    def seconds(self) -> float:
        return len(self) * self.frame_seconds

    def styles(self, remover: Optional[Model] = None) -> Dict[str, float]:
        """The styles recognised in the clip: {name: share}, including 'neutral', largest first; the
        shares add up to 1. `remover`: the model that recognises them; None: the shipped one."""
        remover = remover or Model(_REMOVER)
        shares = (ctypes.c_float * (len(remover.styles) + 1))()
        check(lib.recognise_styles(remover._handle.pointer, self._struct(), shares, len(shares)))
        named = zip([*remover.styles, 'neutral'], shares)
        return dict(sorted((pair for pair in named if pair[0] != _ANY), key=lambda pair: -pair[1]))

    def _struct(self) -> c.structs.Clip:
        """Points into the arrays; checks their shape again, as it can be changed in place."""
        Clip.__post_init__(self)
        return c.structs.Clip(self.skeleton._handle.pointer, len(self), self.frame_seconds,
                      self.rotations.ctypes.data, self.translations.ctypes.data)


@dataclass(frozen=True, eq=False)
class StyledClip(Clip):
    """A clip made by the library. Its arrays are read-only views of the library's memory.

    source_frames: float64 [frames], the fractional input frame that each frame shows.
    contacts:      uint8 [frames, 2], 1 where the left and the right foot are planted.
    gates:         float32 [frames]; 1: motion like the training data, 0: unlike it.
    is_loop:       whether first and last pose match except for travel, as in the input.
    """
    source_frames: np.ndarray
    contacts: np.ndarray
    gates: np.ndarray
    is_loop: bool


def _styled(handle: Handle, skeleton: Skeleton, frame_seconds: float) -> StyledClip:
    at = handle.pointer
    frames, joints = lib.styled_clip_frame_count(at), len(skeleton)
    return StyledClip(
        skeleton, handle.view(lib.styled_clip_rotations(at), (frames, joints, 4)),
        handle.view(lib.styled_clip_translations(at), (frames, joints, 3)), frame_seconds,
        handle.view(lib.styled_clip_source_frames(at), (frames,), np.float64),
        handle.view(lib.styled_clip_contacts(at), (frames, 2), np.uint8),
        handle.view(lib.styled_clip_gates(at), (frames,)), bool(lib.styled_clip_is_loop(at)))


def _keys(name: str, strength: Strength) -> list:
    """A strength as (seconds, strength) pairs."""
    pairs = [(0.0, strength)] if np.ndim(strength) == 0 else strength
    if any(np.shape(pair) != (2,) for pair in pairs):
        raise PanacheError(f'{name}: expected a number, or pairs (seconds, strength)')
    return [(number(seconds, name), number(amount, name)) for seconds, amount in pairs]


def stylize(model: Model, clip: Clip, styles: Mapping[str, Strength], *,
            timing: Union[bool, str] = 'steps', hold_feet: bool = True, style_root: bool = True,
            ease_seconds: float = 0.15, smoothing_seconds: float = 0.04,
            shape: Optional[Mapping[str, float]] = None, max_speed: float = 15,
            loop: str = 'auto', remove: Optional[str] = None,
            remover: Optional[Model] = None, gesture_rate: float = 1, gesture_seed: int = 0,
            sides: Optional[Mapping[str, Union[float, str]]] = None,
            person: Union[int, str, np.ndarray, None] = None, variety: float = 1) -> StyledClip:
    """A clip in a style, or a mix of styles.

    styles: {name: strength}; 0 is neutral, 1 the style as captured, -4 to 4. A list of
            (seconds, strength) is interpolated linearly.
    timing: where to use the style's tempo, which changes the number of frames: 'steps', while the
            feet step; 'all' or 'off'. True is 'steps', False 'off'.
    shape:  scales parts of the styles' effect, 0 to 2 each: {'posture': 0.5, 'left_arm': 0}, see
            panache_shape.
    max_speed: m/s; faster hips count as a jump, see Character.
    loop:   whether first and last pose of the result match except for travel: 'auto', as in the
            clip; 'on', an error if those of the clip are too far apart; 'off'.
    remove: the style of the clip, which is removed first; 'any' for an unknown one.
    remover: the model that removes it; None: the shipped one.
    sides:  {name: side} of styles that are not put on as captured, see Character.set_side().
    person, variety: another person, in addition to the styles, see Model.person().
    gesture_rate, gesture_seed: see Character. A result that loops has no gestures at random.

    If all strengths are 0, the result is bit-identical to the clip (models of recipe panache).
    """
    mapping(styles, 'styles')
    if loop not in _LOOPS:
        raise PanacheError(f"loop: expected 'auto', 'on' or 'off', found {str(loop)[:40]!r}")
    if isinstance(timing, str):
        if timing not in _TIMINGS:
            raise PanacheError(
                f"timing: expected 'steps', 'all' or 'off', found {timing[:40]!r}")
        timing = _TIMINGS.index(timing)
    tracks = (c.structs.StrengthTrack * max(len(styles), 1))()
    for track, (name, strength) in zip(tracks, styles.items()):
        keys = _keys(name, strength)
        track.style, track.key_count = model.find_style(name), len(keys)
        track.keys = (c.structs.StrengthKey * max(len(keys), 1))(*keys)
    options = sized(c.structs.StylizeOptions, ease_seconds=ease_seconds,
                    smoothing_seconds=smoothing_seconds, hold_feet=hold_feet,
                    style_root=style_root, style_timing=c.flag(timing, 'timing'),
                    shape=ctypes.pointer(c.shape_of(shape or {})), max_speed=max_speed,
                    loop=_LOOPS.index(loop), gesture_rate=gesture_rate,
                    gesture_seed=gesture_seed)
    if sides:
        numbers = np.ones(len(model.styles), np.float32)
        for name, side in mapping(sides, 'sides').items():
            numbers[model.find_style(name)] = model.find_side(name, side)
        options.sides = numbers.ctypes.data
    if person is not None:
        who = np.ascontiguousarray(model.person(person, variety))
        options.person = who.ctypes.data
    if remove is not None:
        remover = remover or Model(_REMOVER)
        options.removed = remover.find_style(remove)
        options.remover = remover._handle.pointer
    elif remover is not None:
        raise PanacheError('remover: expected remove too, the style to take off')
    handle = Handle('styled_clip', lib.stylize_clip, model._handle.pointer, clip._struct(), tracks,
                    len(styles), options)
    return _styled(handle, clip.skeleton, clip.frame_seconds)


def retarget(clip: Clip, onto: Skeleton, *, hold_feet: bool = True,
             meet_hands: bool = True) -> StyledClip:
    """Retargets a clip to another skeleton, with its rest pose, proportions, units and axes.

    hold_feet:  puts feet on the floor, and keeps them in place while they are planted.
    meet_hands: makes hands meet if they do in the clip, within reach of the arms.
    """
    options = sized(c.structs.RetargetOptions, hold_feet=hold_feet, meet_hands=meet_hands)
    handle = Handle('styled_clip', lib.retarget_clip, clip._struct(), onto._handle.pointer,
                    options)
    return _styled(handle, onto, clip.frame_seconds)

"""Motion files: BVH, GLB, glTF, VRM and FBX."""

import operator
import os
import pathlib
import warnings
from ctypes import byref
from dataclasses import dataclass
from typing import Any, Dict, List, Mapping, Optional, Sequence, Union

import numpy as np

from . import _library as c
from ._files import check_free, read_bytes, write
from ._library import Handle, PanacheError, check, lib, mapping, number, take_bytes, utf8
from .clips import Clip, Skeleton, Strength, StyledClip, _options, retarget, stylize
from .model import Model, model_of

Path = Union[str, os.PathLike]
_MODES = ('replace', 'last', 'first')


class MotionFile:
    """A motion file: its joints, its motions, and all other content, which is preserved when it is
    written again. Immutable.

    joint_names, parents: of its joints, parents before children.
    clip_names:           of its motions, '' without a name (BVH).
    moves:                whether each motion moves a joint of the humanoid. Others, such as
                          animations of morph weights or props, are skipped when a whole file is
                          stylized or retargeted.

    fps: overrides a wrong or missing frame rate, for reading and writing.
    """

    def __init__(self, path: Path, fps: Optional[float] = None):
        self._open(os.fsdecode(path), read_bytes(path), fps)

    def _open(self, path: str, content: bytes, fps: Optional[float]) -> 'MotionFile':
        self.path, self._content, self._fps = path, content, fps
        name = os.fsencode(path)
        if fps is None:
            self._handle = Handle('motion_file', lib.motion_file_create, content, len(content), name)
        else:
            self._handle = Handle('motion_file', lib.motion_file_create_at_rate, content,
                                  len(content), name, number(fps, 'fps'))
        at, joint = self._handle.pointer, c.structs.Joint()
        self.joint_names: List[str] = []
        self.parents: List[int] = []
        for j in range(lib.motion_file_joint_count(at)):
            lib.motion_file_get_joint(at, j, byref(joint))
            self.joint_names.append(joint.name.decode(errors='replace'))
            self.parents.append(joint.parent)
        self.clip_names: List[str] = [
            lib.motion_file_clip_name(at, i).decode(errors='replace')
            for i in range(lib.motion_file_clip_count(at))]
        self.moves: List[bool] = [lib.motion_file_clip_moves(at, i) != 0
                                  for i in range(len(self.clip_names))]
        return self

    def __reduce__(self):  # Pickles the content, as the file may change meanwhile.
        return _file_again, (self.path, self._content, self._fps)

    @property
    def notes(self) -> List[str]:
        """Warnings about a file that was read: a wrong number of frames, keyframes before 0 s,
        skipped motions, steps too fast or slow for the legs."""
        text = take_bytes(lib.motion_file_get_notes, self._handle.pointer)
        return text.decode(errors='replace').splitlines()

    def _body_motions(self) -> List[int]:
        """The indices of the motions that move the humanoid; issues all notes as warnings."""
        self._place(0)
        found = [i for i, moves in enumerate(self.moves) if moves]
        if not found:
            raise PanacheError(f'{self.path}: none of its motions moves a joint of the humanoid; '
                               'expected an animation that does')
        for note in self.notes:
            warnings.warn(note, stacklevel=3)
        return found

    def __repr__(self) -> str:
        return (f'<panache.MotionFile {self.path!r}: {len(self.joint_names)} joints, '
                f'{len(self.clip_names)} motions>')

    def skeleton(self, clip: int = 0, *, metres_per_unit: float = 0,
                 up_axis: Optional[str] = None,
                 human_joints: Optional[Mapping[str, int]] = None) -> Skeleton:
        """The skeleton for a motion; with clip=-1, that of the character in its rest pose, as a
        target of `retarget()`. Options as for `Skeleton`."""
        options, kept = _options(metres_per_unit, up_axis, human_joints)
        handle = Handle('skeleton', lib.motion_file_create_skeleton, self._handle.pointer,
                        c.whole(clip, 'clip'), options)
        told = {'metres_per_unit': metres_per_unit, 'up_axis': up_axis,
                'human_joints': dict(human_joints or {})}
        return Skeleton.__new__(Skeleton)._adopt(
            handle, self.joint_names, self.parents,
            (_skeleton_of_file_again, (self.path, self._content, self._fps, clip, told)))

    def clip(self, which: Union[int, str] = 0, skeleton: Optional[Skeleton] = None) -> Clip:
        """A motion, by index or name. Its arrays are read-only views of the parsed file."""
        which = self._place(which)
        found = c.structs.Clip()
        check(lib.motion_file_get_clip(self._handle.pointer, which, found))
        shape = (found.frame_count, len(self.joint_names))
        return Clip(skeleton or self.skeleton(which),
                    self._handle.view(found.rotations, (*shape, 4)),
                    self._handle.view(found.translations, (*shape, 3)), found.frame_seconds)

    def _place(self, which: Union[int, str]) -> int:
        if not self.clip_names:
            raise PanacheError(f'{self.path}: holds a skeleton and no motion; expected a file with '
                               'an animation')
        if isinstance(which, str) and self.clip_names == [''] and which:
            raise PanacheError(f'{self.path}: holds one motion, which has no name; expected 0, '
                               f'found {which!r}')
        if isinstance(which, str) and which not in self.clip_names:
            raise PanacheError(f'{self.path}: holds no motion {which!r}; expected one of '
                               f'{", ".join(map(repr, self.clip_names))}')
        if isinstance(which, str):
            return self.clip_names.index(which)
        try:
            place = operator.index(which)
        except TypeError:
            raise PanacheError(f'{self.path}: expected the place or name of a motion, found '
                               f'{type(which).__name__}') from None
        if not 0 <= place < len(self.clip_names):
            raise PanacheError(f'{self.path}: there is no motion {place}; it has '
                               f'{len(self.clip_names)}, from 0')
        return place

    def encode(self, edits: Sequence['Edit'], mode: str = 'first') -> bytes:
        """The bytes of the file with new frames. Unchanged values keep the exact numbers of the
        file.

        mode: 'replace', 'last' or 'first': whether the edits replace the file's own motions, or
              are added after or before them. A BVH file has one motion, which is replaced.
        """
        if mode not in _MODES:
            raise PanacheError(f'there is no mode {mode!r}; expected one of {", ".join(_MODES)}')
        array = (c.structs.ClipEdit * max(len(edits), 1))()
        kept = []
        for slot, edit in zip(array, edits):
            slot.clip, slot.name = edit.which, utf8(edit.name, 'name')
            slot.frames = edit.clip._struct()
            if len(edit.clip.skeleton) != len(self.joint_names):
                raise PanacheError(f'{self.path}: has {len(self.joint_names)} joints, and the clip '
                                   f'{len(edit.clip.skeleton)}')
            if edit.source_frames is not None:
                source = np.ascontiguousarray(edit.source_frames, np.float64)
                if source.shape != (len(edit.clip),):
                    raise PanacheError(f'source_frames: expected an array of shape '
                                       f'({len(edit.clip)},), found {source.shape}')
                kept.append(source)
                slot.source_frames = source.ctypes.data
        return take_bytes(lib.motion_file_write, self._handle.pointer, array, len(edits),
                          _MODES.index(mode))

    def write(self, path: Path, clip: Clip, which: int = 0, name: str = '', mode: str = 'first',
              force: bool = False) -> None:
        """Writes the file atomically with `clip` as new frames of the motion `which`, or as a new
        motion if that is -1. Overwrites an existing file only with `force`."""
        self.write_all(path, [Edit(clip, which, name)], mode, force)

    def write_all(self, path: Path, edits: Sequence['Edit'], mode: str = 'first',
                  force: bool = False) -> None:
        """The same for several motions."""
        self._check_output(path, force)
        write(path, self.encode(edits, mode), force)

    def _check_output(self, path: Path, force: bool) -> None:
        extension = pathlib.Path(self.path).suffix
        if pathlib.Path(path).suffix.lower() != extension.lower():
            raise PanacheError(f'{path}: expected a name that ends in {extension}, as that of '
                               f'{self.path}; panache convert writes other formats')
        check_free(path, force)


def _file_again(path, content, fps) -> MotionFile:
    return MotionFile.__new__(MotionFile)._open(path, content, fps)


def _skeleton_of_file_again(path, content, fps, clip, told) -> Skeleton:
    return _file_again(path, content, fps).skeleton(clip, **told)


@dataclass
class Edit:
    """New frames for the motion `which` of a file, or a new motion if that is -1.

    source_frames: [frames], the frame of the motion that each comes from; by default those of a
                   StyledClip, otherwise frame by frame.
    """
    clip: Clip
    which: int = 0
    name: str = ''
    source_frames: Optional[np.ndarray] = None

    def __post_init__(self):
        if self.source_frames is None and isinstance(self.clip, StyledClip):
            self.source_frames = self.clip.source_frames


def read(path: Path, which: Union[int, str, None] = None, fps: Optional[float] = None) -> Clip:
    """A motion of a file, by index or name; by default the first that moves the humanoid, with the
    file's notes as warnings. `fps` as for `MotionFile`."""
    file = MotionFile(path, fps)
    if which is None:
        return file.clip(file._body_motions()[0])
    return file.clip(which)


def _title(name: str, path: str) -> str:
    return name or pathlib.Path(path).stem


def _amount(strength: Strength) -> str:
    if np.isscalar(strength):
        return f'{strength:g}'
    amounts = {amount for _, amount in strength}
    return f'{amounts.pop():g}' if len(amounts) == 1 else 'varies'


def stylize_file(source: Path, output: Path, styles: Mapping[str, Strength],
                 model: Optional[Model] = None, *, mode: str = 'first', force: bool = False,
                 fps: Optional[float] = None, **options: Any) -> None:
    """Stylizes all motions of a file into another of the same format, with the same bytes as
    `panache stylize`. Options as for `stylize()`, `fps` as for `MotionFile`; the default model is
    the shipped one. Motions that move no joint of the humanoid stay, with a warning."""
    file = MotionFile(source, fps)
    motions = file._body_motions()
    file._check_output(output, force)
    model = model_of(model)
    text = ', '.join(f'{name} {_amount(strength)}'
                     for name, strength in mapping(styles, 'styles').items())
    edits = [Edit(stylize(model, file.clip(i), styles, **options), i,
                  f'{_title(file.clip_names[i], file.path)} ({text})')
             for i in motions]
    write(output, file.encode(edits, mode), force)


def retarget_file(source: Path, character: Path, output: Path, *, mode: str = 'replace',
                  force: bool = False, fps: Optional[float] = None, **options: Any) -> None:
    """Retargets all motions of a file to the character of another, as `panache retarget` does. The
    output is the character's file with its motions replaced, or added according to `mode`. Options
    as for `retarget()`; `fps`: of the motions, as for `MotionFile`. Motions that move no joint of
    the humanoid are skipped, with a warning."""
    file, onto = MotionFile(source, fps), MotionFile(character)
    motions = file._body_motions()
    onto._check_output(output, force)
    skeleton = onto.skeleton(-1)
    edits = [Edit(retarget(file.clip(i), skeleton, **options), -1,
                  _title(file.clip_names[i], file.path))
             for i in motions]
    write(output, onto.encode(edits, mode), force)


def info(path: Path, fps: Optional[float] = None) -> Dict[str, Any]:
    """Describes a file. For a motion file: 'joints' (names), 'clips' (name, frames, seconds,
    moves), 'notes' (as MotionFile.notes), 'mapping' (the joint of each human joint; None if there
    is no humanoid, with the reason in 'error'). `fps` as for `MotionFile`. For a model: 'styles'
    and 'metadata'."""
    if pathlib.Path(path).suffix == '.safetensors':
        model = Model(path)
        return {'styles': model.styles, 'metadata': model.metadata}
    file = MotionFile(path, fps)
    clips = []
    for i, name in enumerate(file.clip_names):
        clip = c.structs.Clip()
        check(lib.motion_file_get_clip(file._handle.pointer, i, clip))
        clips.append({'name': name, 'frames': clip.frame_count,
                      'seconds': clip.frame_count * clip.frame_seconds,
                      'moves': file.moves[i]})
    out: Dict[str, Any] = {'joints': file.joint_names, 'clips': clips, 'notes': file.notes,
                           'mapping': None}
    try:
        shown = file.moves.index(True) if True in file.moves else 0
        out['mapping'] = file.skeleton(shown if clips else -1).mapping()
    except PanacheError as error:
        out['error'] = str(error)
    return out

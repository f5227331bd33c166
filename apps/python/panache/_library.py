"""The C interface (include/panache/panache.h) by ctypes."""

import ctypes
import operator
import pathlib
from collections.abc import Mapping
from ctypes import (POINTER, Structure, byref, c_char_p, c_double, c_float, c_int32, c_size_t,
                    c_uint32, c_void_p, sizeof)

import numpy as np

HERE = pathlib.Path(__file__).parent
VERSION = (0, 2)  # Of the header that the structs below are those of.


class PanacheError(Exception):
    """What the library says of bad input, in one sentence. `kind` tells what kind of mistake it is,
    for programs that help with it: one of ERROR_KINDS."""

    def __init__(self, message: str, kind: str = 'other'):
        super().__init__(message)
        self.kind = kind


# In the order of panache_error_kind.
ERROR_KINDS = (
    'other', 'file_exists', 'rate_needed', 'not_humanoid', 'unknown_style', 'no_styles',
    'style_exists', 'is_model', 'is_style_file', 'style_of_another', 'not_safetensors',
    'model_cannot_learn', 'other_skeletons', 'loop_open', 'loop_strengths', 'bad_style_name')


class Joint(Structure):
    _fields_ = [('name', c_char_p), ('parent', c_int32), ('rotation', c_float * 4),
                ('translation', c_float * 3)]


class HumanJoint(Structure):
    _fields_ = [('vrm_name', c_char_p), ('joint', c_int32)]


class SkeletonOptions(Structure):
    _fields_ = [('struct_size', c_uint32), ('metres_per_unit', c_float), ('up_axis', c_char_p),
                ('rotations', c_void_p), ('translations', c_void_p), ('pose_count', c_int32),
                ('human_joint_count', c_int32), ('human_joints', POINTER(HumanJoint))]


class CharacterOptions(Structure):
    _fields_ = [('struct_size', c_uint32), ('ease_seconds', c_float),
                ('smoothing_seconds', c_float), ('hold_feet', c_int32), ('style_root', c_int32),
                ('skip_cycles', c_int32), ('max_lag', c_double), ('max_lead', c_double),
                ('max_speed', c_double), ('remover', c_void_p), ('gesture_rate', c_float),
                ('gesture_seed', c_uint32)]


class Shape(Structure):
    _fields_ = [('struct_size', c_uint32), ('strength', c_float), ('posture', c_float),
                ('dynamics', c_float), ('timing', c_float), ('legs', c_float), ('torso', c_float),
                ('left_arm', c_float), ('right_arm', c_float), ('foot_lock', c_float)]


class Pose(Structure):
    """panache_input_pose and panache_output_pose."""
    _fields_ = [('rotations', c_void_p), ('translations', c_void_p)]


class Report(Structure):
    _fields_ = [('struct_size', c_uint32), ('gate', c_float), ('contacts', c_float * 2),
                ('rate', c_double), ('ahead', c_double)]


class Clip(Structure):
    _fields_ = [('skeleton', c_void_p), ('frame_count', c_int32), ('frame_seconds', c_double),
                ('rotations', c_void_p), ('translations', c_void_p)]


class Key(Structure):
    _fields_ = [('seconds', c_double), ('strength', c_float)]


class Track(Structure):
    _fields_ = [('style', c_int32), ('key_count', c_int32), ('keys', POINTER(Key))]


class StylizeOptions(Structure):
    _fields_ = [('struct_size', c_uint32), ('ease_seconds', c_float),
                ('smoothing_seconds', c_float), ('hold_feet', c_int32), ('style_root', c_int32),
                ('style_timing', c_int32), ('shape', POINTER(Shape)), ('max_speed', c_double),
                ('loop', c_int32), ('removed', c_int32), ('remover', c_void_p),
                ('gesture_rate', c_float), ('gesture_seed', c_uint32)]


class RetargetOptions(Structure):
    _fields_ = [('struct_size', c_uint32), ('hold_feet', c_int32), ('meet_hands', c_int32)]


class Pair(Structure):
    _fields_ = [('neutral', Clip), ('styled', Clip)]


class LearntReport(Structure):
    _fields_ = [('struct_size', c_uint32), ('was_tested', c_int32), ('warnings', c_char_p),
                ('held_back_cm', c_double), ('mean_posture_cm', c_double),
                ('untouched_cm', c_double), ('people', c_int32), ('is_known', c_int32),
                ('certainty', c_double)]


class ClipEdit(Structure):
    _fields_ = [('clip', c_int32), ('name', c_char_p), ('frames', Clip),
                ('source_frames', c_void_p)]


_H = c_void_p  # A handle.
_OUT = POINTER(c_void_p)
# Results and arguments of all functions. Those that give an int32 and take an _OUT can fail.
_FUNCTIONS = {
    'version': (c_int32, []),
    'last_error': (c_char_p, []),
    'last_error_kind': (c_int32, []),
    'bytes_data': (c_void_p, [_H]),
    'bytes_size': (c_size_t, [_H]),
    'bytes_destroy': (None, [_H]),
    'model_create': (c_int32, [c_char_p, c_size_t, _OUT]),
    'model_destroy': (None, [_H]),
    'model_style_count': (c_int32, [_H]),
    'model_style_name': (c_char_p, [_H, c_int32]),
    'model_style_group': (c_char_p, [_H, c_int32]),
    'model_gesture_count': (c_int32, [_H, c_int32]),
    'model_gesture_name': (c_char_p, [_H, c_int32, c_int32]),
    'model_find_style': (c_int32, [_H, c_char_p]),
    'skeleton_create': (c_int32, [POINTER(Joint), c_int32, POINTER(SkeletonOptions), _OUT]),
    'skeleton_destroy': (None, [_H]),
    'skeleton_joint_count': (c_int32, [_H]),
    'skeleton_find': (c_int32, [_H, c_char_p]),
    'character_create': (c_int32, [_H, _H, POINTER(CharacterOptions), _OUT]),
    'character_destroy': (None, [_H]),
    'character_set_strength': (None, [_H, c_int32, c_float]),
    'character_trigger': (c_int32, [_H, c_int32, c_int32]),
    'character_set_shape': (c_int32, [_H, POINTER(Shape)]),
    'character_step': (None, [_H, Pose, c_double, Pose]),
    'step_many': (None, [POINTER(c_void_p), c_int32, POINTER(Pose), c_double, POINTER(Pose)]),
    'character_reset': (None, [_H]),
    'character_get_report': (c_int32, [_H, POINTER(Report)]),
    'character_state_size': (c_size_t, [_H]),
    'character_save': (None, [_H, c_void_p]),
    'character_restore': (c_int32, [_H, c_char_p, c_size_t]),
    'character_set_removed': (None, [_H, c_int32]),
    'recognise_styles': (c_int32, [_H, POINTER(Clip), POINTER(c_float), c_int32]),
    'stylize_clip': (c_int32, [_H, POINTER(Clip), POINTER(Track), c_int32,
                               POINTER(StylizeOptions), _OUT]),
    'styled_clip_destroy': (None, [_H]),
    'styled_clip_frame_count': (c_int32, [_H]),
    'styled_clip_rotations': (c_void_p, [_H]),
    'styled_clip_translations': (c_void_p, [_H]),
    'styled_clip_source_frames': (c_void_p, [_H]),
    'styled_clip_contacts': (c_void_p, [_H]),
    'styled_clip_gates': (c_void_p, [_H]),
    'styled_clip_is_loop': (c_int32, [_H]),
    'retarget_clip': (c_int32, [POINTER(Clip), _H, POINTER(RetargetOptions), _OUT]),
    'learn': (c_int32, [c_char_p, c_size_t, POINTER(Pair), c_int32, c_char_p, c_int32, _OUT]),
    'learn_alone': (c_int32, [c_char_p, c_size_t, c_char_p, c_size_t, POINTER(Clip), c_char_p,
                              c_int32, _OUT]),
    'learnt_destroy': (None, [_H]),
    'learnt_model': (c_void_p, [_H, POINTER(c_size_t)]),
    'learnt_verdict': (c_char_p, [_H]),
    'learnt_get_report': (c_int32, [_H, POINTER(LearntReport)]),
    'styles_add': (c_int32, [c_char_p, c_size_t, c_char_p, c_size_t, c_int32, _OUT]),
    'styles_remove': (c_int32, [c_char_p, c_size_t, c_char_p, _OUT]),
    'styles_extract': (c_int32, [c_char_p, c_size_t, c_char_p, _OUT]),
    'motion_file_create': (c_int32, [c_char_p, c_size_t, c_char_p, _OUT]),
    'motion_file_create_at_rate': (c_int32, [c_char_p, c_size_t, c_char_p, c_double, _OUT]),
    'motion_file_destroy': (None, [_H]),
    'motion_file_joint_count': (c_int32, [_H]),
    'motion_file_get_joint': (None, [_H, c_int32, POINTER(Joint)]),
    'motion_file_clip_count': (c_int32, [_H]),
    'motion_file_clip_name': (c_char_p, [_H, c_int32]),
    'motion_file_clip_moves': (c_int32, [_H, c_int32]),
    'motion_file_get_notes': (c_int32, [_H, _OUT]),
    'motion_file_get_clip': (c_int32, [_H, c_int32, POINTER(Clip)]),
    'motion_file_create_skeleton': (c_int32, [_H, c_int32, POINTER(SkeletonOptions), _OUT]),
    'motion_file_write': (c_int32, [_H, POINTER(ClipEdit), c_int32, c_int32, _OUT]),
    'samples_create': (c_int32, [POINTER(Pair), c_int32, _OUT]),
    'samples_destroy': (None, [_H]),
    'samples_count': (c_int32, [_H]),
    'samples_windows': (c_void_p, [_H]),
    'samples_changes': (c_void_p, [_H]),
    'samples_log_rates': (c_void_p, [_H]),
    'samples_contacts': (c_void_p, [_H]),
}


def _open():
    folder = HERE / 'lib'
    own = folder / 'libpanache.so'
    if not own.exists():
        raise PanacheError(f'there is no {own}; install the wheel that ./run python makes')
    for other in sorted(folder.iterdir()):
        if other != own:  # What it needs is found where it has been opened already.
            ctypes.CDLL(str(other), mode=ctypes.RTLD_GLOBAL)
    library = ctypes.CDLL(str(own))
    for name, (result, arguments) in _FUNCTIONS.items():
        function = getattr(library, 'panache_' + name)
        function.restype, function.argtypes = result, arguments
        setattr(library, name, function)
    found = library.version()
    if (found // 10000, found // 100 % 100) != VERSION:
        raise PanacheError(f'{own}: is version {found // 10000}.{found // 100 % 100}; expected '
                           f'{VERSION[0]}.{VERSION[1]}; install the wheel again')
    return library


lib = _open()


def version() -> str:
    """The library's version: '0.2.0'."""
    number = lib.version()
    return f'{number // 10000}.{number // 100 % 100}.{number % 100}'


def utf8(text, what: str) -> bytes:
    """A name as the library takes it; bytes of a path that are no UTF-8 stay what they are."""
    if not isinstance(text, str):
        raise PanacheError(f'{what}: expected a string, found {type(text).__name__}')
    return text.encode(errors='surrogateescape')


def number(value, what: str) -> float:
    """A number of any type."""
    try:
        return float(value)
    except (TypeError, ValueError, OverflowError):
        raise PanacheError(f'{what}: expected a number, found {str(value)[:40]!r}') from None


def whole(value, what: str) -> int:
    """A place or a count."""
    try:
        return operator.index(value)
    except TypeError:
        raise PanacheError(f'{what}: expected a whole number, found {str(value)[:40]!r}') from None


def check(status: int) -> None:
    """Raises what the library says of a failure."""
    if status != 0:
        raise PanacheError(lib.last_error().decode(), ERROR_KINDS[lib.last_error_kind()])


class Handle:
    """An object of the library, destroyed when it is no longer used."""

    def __init__(self, kind: str, create, *arguments):
        self._destroy = getattr(lib, kind + '_destroy')
        self.pointer = c_void_p()
        check(create(*arguments, byref(self.pointer)))

    def __del__(self):
        if getattr(self, 'pointer', None):
            self._destroy(self.pointer)

    def __reduce__(self):  # By pickle and copy: two would give the same object back.
        raise TypeError('an object of the library cannot be copied; make another one')

    def view(self, address: int, shape, dtype=np.float32) -> np.ndarray:
        """An array of the library's memory, read-only, which keeps this object. No copy."""
        dtype = np.dtype(dtype)
        size = int(np.prod(shape)) * dtype.itemsize
        if not size:
            return np.empty(shape, dtype)
        memory = (ctypes.c_char * size).from_address(address)
        memory.owner = self
        out = np.frombuffer(memory, dtype).reshape(shape)
        out.flags.writeable = False
        return out


def take_bytes(create, *arguments) -> bytes:
    """The content of a panache_bytes that a function makes."""
    out = Handle('bytes', create, *arguments)
    return ctypes.string_at(lib.bytes_data(out.pointer), lib.bytes_size(out.pointer))


def floats(array, shape, what: str) -> np.ndarray:
    """`array` as contiguous float32 of this shape, None for any size: itself, if it is that."""
    out = np.ascontiguousarray(array, np.float32)
    if out.ndim != len(shape) or any(want not in (None, has)
                                     for want, has in zip(shape, out.shape)):
        wanted = ', '.join('any' if n is None else str(n) for n in shape)
        raise PanacheError(f'{what}: expected an array of shape ({wanted}), found '
                           f'{tuple(out.shape)}')
    return out


def fixed(shape) -> np.ndarray:
    """Zeros, float32, in memory that stays where it is: such an array cannot be resized."""
    size = int(np.prod(shape)) * 4
    return np.frombuffer(bytearray(size), np.float32).reshape(shape)


def mapping(value, what: str):
    """Names with numbers, or an error."""
    if not isinstance(value, Mapping):
        raise PanacheError(f'{what}: expected a dict of names and numbers, found '
                           f'{type(value).__name__}')
    return value


def flag(value, what: str) -> int:
    """True or False, or a count."""
    if not isinstance(value, (int, np.integer, np.bool_)):
        raise PanacheError(f'{what}: expected True or False, found {str(value)[:40]!r}')
    return int(value)


def sized(struct, **fields):
    """A struct that begins with its size; of fields that are numbers any type will do."""
    takes = {c_float: number, c_double: number, c_int32: flag}
    for name, kind in struct._fields_:
        if name in fields and kind in takes:
            fields[name] = takes[kind](fields[name], name)
    return struct(struct_size=sizeof(struct), **fields)


SHAPE = tuple(name for name, _ in Shape._fields_[1:])


def shape_of(amounts) -> Shape:
    """A panache_shape: 1 where `amounts` names nothing else."""
    for name in mapping(amounts, 'shape'):
        if name not in SHAPE:
            raise PanacheError(f'there is no amount {name!r} of a shape; expected one of '
                               f'{", ".join(SHAPE)}')
    return sized(Shape, **{name: number(amounts.get(name, 1.0), name) for name in SHAPE})

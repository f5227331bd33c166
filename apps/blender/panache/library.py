"""The C interface of Panache (include/panache/panache.h), as far as the add-on needs it."""

import ctypes
import glob
import os
from ctypes import (POINTER, Structure, byref, c_char_p, c_double, c_float, c_int32, c_size_t,
                    c_uint32, c_void_p, sizeof)

HERE = os.path.dirname(__file__)
# The joints of the humanoid that a style turns, by their VRM names.
HUMAN_JOINTS = ['hips', 'spine', 'chest', 'neck', 'head'] + [
    side + joint for side in ('left', 'right')
    for joint in ('Shoulder', 'UpperArm', 'LowerArm', 'Hand', 'UpperLeg', 'LowerLeg', 'Foot',
                  'Toes')]
SHAPE = ('strength', 'posture', 'dynamics', 'timing', 'legs', 'torso', 'left_arm', 'right_arm',
         'foot_lock')
TIMINGS = ('off', 'steps', 'all')  # As panache_stylize_options.style_timing counts them.


class PanacheError(Exception):
    """What the library says of bad input, in one sentence."""


class _Joint(Structure):
    _fields_ = [('name', c_char_p), ('parent', c_int32), ('rotation', c_float * 4),
                ('translation', c_float * 3)]


class _HumanJoint(Structure):
    _fields_ = [('vrm_name', c_char_p), ('joint', c_int32)]


class _SkeletonOptions(Structure):
    _fields_ = [('struct_size', c_uint32), ('metres_per_unit', c_float), ('up_axis', c_char_p),
                ('rotations', POINTER(c_float)), ('translations', POINTER(c_float)),
                ('pose_count', c_int32), ('human_joint_count', c_int32),
                ('human_joints', POINTER(_HumanJoint))]


class _Clip(Structure):
    _fields_ = [('skeleton', c_void_p), ('frame_count', c_int32), ('frame_seconds', c_double),
                ('rotations', POINTER(c_float)), ('translations', POINTER(c_float))]


class _Key(Structure):
    _fields_ = [('seconds', c_double), ('strength', c_float)]


class _Track(Structure):
    _fields_ = [('style', c_int32), ('key_count', c_int32), ('keys', POINTER(_Key))]


class _Shape(Structure):
    _fields_ = [('struct_size', c_uint32)] + [(name, c_float) for name in SHAPE]


class _StylizeOptions(Structure):
    _fields_ = [('struct_size', c_uint32), ('ease_seconds', c_float),
                ('smoothing_seconds', c_float), ('hold_feet', c_int32), ('style_root', c_int32),
                ('style_timing', c_int32), ('shape', POINTER(_Shape)), ('max_speed', c_double),
                ('loop', c_int32), ('removed', c_int32), ('remover', c_void_p),
                ('gesture_rate', c_float), ('gesture_seed', c_uint32)]


class _Pair(Structure):
    _fields_ = [('neutral', _Clip), ('styled', _Clip)]


class _LearntReport(Structure):
    _fields_ = [('struct_size', c_uint32), ('was_tested', c_int32), ('warnings', c_char_p),
                ('held_back_cm', c_double), ('mean_posture_cm', c_double),
                ('untouched_cm', c_double)]


def _open():
    folder = os.path.join(HERE, 'lib')
    own = os.path.join(folder, 'libpanache.so')
    if not os.path.exists(own):
        raise PanacheError('the add-on has no library in ' + folder +
                           '; install the zip that ./run blender makes')
    for name in glob.glob(os.path.join(folder, '*')):
        if name != own:  # What it needs is found where it has been opened already.
            ctypes.CDLL(name, mode=ctypes.RTLD_GLOBAL)
    library = ctypes.CDLL(own)
    library.panache_last_error.restype = c_char_p
    library.panache_model_style_name.restype = c_char_p
    library.panache_model_style_name.argtypes = [c_void_p, c_int32]
    library.panache_model_style_group.restype = c_char_p
    library.panache_model_style_group.argtypes = [c_void_p, c_int32]
    library.panache_model_style_count.argtypes = [c_void_p]
    library.panache_skeleton_find.argtypes = [c_void_p, c_char_p]
    for kind in ('model', 'skeleton', 'styled_clip', 'learnt'):
        getattr(library, 'panache_%s_destroy' % kind).argtypes = [c_void_p]
    for name, kind in (('rotations', c_float), ('translations', c_float),
                       ('source_frames', c_double), ('gates', c_float)):
        getter = getattr(library, 'panache_styled_clip_' + name)
        getter.argtypes, getter.restype = [c_void_p], POINTER(kind)
    library.panache_styled_clip_frame_count.argtypes = [c_void_p]
    library.panache_learnt_model.argtypes = [c_void_p, POINTER(c_size_t)]
    library.panache_learnt_model.restype = c_void_p
    library.panache_learnt_verdict.argtypes = [c_void_p]
    library.panache_learnt_verdict.restype = c_char_p
    library.panache_learnt_get_report.argtypes = [c_void_p, POINTER(_LearntReport)]
    library.panache_model_create.argtypes = [c_char_p, c_size_t, POINTER(c_void_p)]
    library.panache_skeleton_create.argtypes = [POINTER(_Joint), c_int32,
                                                POINTER(_SkeletonOptions), POINTER(c_void_p)]
    library.panache_stylize_clip.argtypes = [c_void_p, POINTER(_Clip), POINTER(_Track), c_int32,
                                             POINTER(_StylizeOptions), POINTER(c_void_p)]
    library.panache_learn.argtypes = [c_char_p, c_size_t, POINTER(_Pair), c_int32, c_char_p,
                                      c_int32, POINTER(c_void_p)]
    library.panache_styles_add.argtypes = [c_char_p, c_size_t, c_char_p, c_size_t, c_int32,
                                           POINTER(c_void_p)]
    library.panache_bytes_data.argtypes = library.panache_bytes_size.argtypes = [c_void_p]
    library.panache_bytes_destroy.argtypes = [c_void_p]
    library.panache_bytes_data.restype, library.panache_bytes_size.restype = c_void_p, c_size_t
    return library


_library = None


def library():
    global _library
    if _library is None:
        _library = _open()
    return _library


# Text of any bytes: what is not UTF-8 is replaced, as nothing here is looked up by such a name.
def _text(content):
    return content.decode(errors='replace')


def _bytes(text):
    return text.encode(errors='replace')


def _check(status):
    if status != 0:
        raise PanacheError(_text(library().panache_last_error()))


class _Handle:
    kind = ''

    def __init__(self, handle):
        self.handle = handle

    def __del__(self):
        if self.handle:
            getattr(library(), 'panache_%s_destroy' % self.kind)(self.handle)


def _floats(numbers):
    return (c_float * len(numbers))(*numbers)


def _with_style(content, path):
    """The bytes of a model with the style of a style file too."""
    with open(path, 'rb') as file:
        style = file.read()
    out = c_void_p()
    _check(library().panache_styles_add(content, len(content), style, len(style), 1, byref(out)))
    merged = ctypes.string_at(library().panache_bytes_data(out), library().panache_bytes_size(out))
    library().panache_bytes_destroy(out)
    return merged


class Model(_Handle):
    kind = 'model'

    def __init__(self, path, folder=''):
        """`folder` holds style files: their styles are there, too, but not in `content`."""
        self.handle = None
        self.path = path
        with open(path, 'rb') as file:
            self.content = file.read()
        self.problems = []  # Of style files that are not in use.
        merged = self.content
        files = glob.glob(os.path.join(glob.escape(folder), '*.safetensors')) if folder else []
        for name in sorted(files):
            try:
                merged = _with_style(merged, name)
            except (PanacheError, OSError) as error:
                self.problems.append('%s: %s' % (name, error))
        out = c_void_p()
        _check(library().panache_model_create(merged, len(merged), byref(out)))
        super().__init__(out)
        count = library().panache_model_style_count(out)
        self.styles = [_text(library().panache_model_style_name(out, i)) for i in range(count)]
        # {group: its styles}, in the model's order; '' has the styles of no group.
        self.groups = {}
        for i, style in enumerate(self.styles):
            group = _text(library().panache_model_style_group(out, i))
            self.groups.setdefault(group, []).append(style)


class Motion:
    """Poses of a skeleton: rotations [frames][joints][4] as x y z w and translations
    [frames][joints][3], each relative to the parent, in flat lists."""

    def __init__(self, frame_count, rotations, translations):
        self.frame_count = frame_count
        self.rotations = _floats(rotations)
        self.translations = _floats(translations)


class Skeleton(_Handle):
    kind = 'skeleton'

    def __init__(self, joints, motion):
        """joints: (name, parent, rotation x y z w, translation) at rest, parents first. `motion`
        tells axes, floor and sides."""
        self.handle = None
        array = (_Joint * len(joints))()
        for slot, (name, parent, rotation, translation) in zip(array, joints):
            slot.name, slot.parent = _bytes(name), parent
            slot.rotation[:], slot.translation[:] = rotation, translation
        options = _SkeletonOptions(struct_size=sizeof(_SkeletonOptions),
                                   rotations=motion.rotations, translations=motion.translations,
                                   pose_count=motion.frame_count)
        out = c_void_p()
        _check(library().panache_skeleton_create(array, len(joints), byref(options), byref(out)))
        super().__init__(out)
        self.names = [name for name, *_ in joints]

    def mapping(self):
        """The name of each human joint's joint, None where the rig has none."""
        places = {human: library().panache_skeleton_find(self.handle, human.encode())
                  for human in HUMAN_JOINTS}
        return {human: self.names[i] if i >= 0 else None for human, i in places.items()}

    def clip(self, motion, frame_seconds):
        return _Clip(self.handle, motion.frame_count, frame_seconds, motion.rotations,
                     motion.translations)


class Styled:
    """A clip that was styled: lists as in Motion, and per frame the input's frame (fractional) and
    how much of the style's answer to this very motion was used, 0 to 1."""

    def __init__(self, handle, joint_count):
        self.frame_count = library().panache_styled_clip_frame_count(handle)
        total = self.frame_count * joint_count
        get = lambda name: getattr(library(), 'panache_styled_clip_' + name)(handle)
        self.rotations = get('rotations')[:4 * total]
        self.translations = get('translations')[:3 * total]
        self.source_frames = get('source_frames')[:self.frame_count]
        self.gates = get('gates')[:self.frame_count]
        library().panache_styled_clip_destroy(handle)


def stylize(model, skeleton, motion, frame_seconds, strengths, shape, timing):
    """strengths: {style: number}; shape: {name of SHAPE: number}; timing: one of TIMINGS."""
    tracks = (_Track * max(1, len(strengths)))()
    keys = []
    for track, (style, strength) in zip(tracks, strengths.items()):
        keys.append(_Key(0, strength))
        track.style = model.styles.index(style)
        track.key_count, track.keys = 1, ctypes.pointer(keys[-1])
    amounts = _Shape(sizeof(_Shape), *[shape.get(name, 1.0) for name in SHAPE])
    options = _StylizeOptions(sizeof(_StylizeOptions), 0.15, 0.04, 1, 1,
                              TIMINGS.index(timing),
                              ctypes.pointer(amounts), 15, 1, 0)
    out = c_void_p()
    clip = skeleton.clip(motion, frame_seconds)
    _check(library().panache_stylize_clip(model.handle, byref(clip), tracks, len(strengths),
                                          byref(options), byref(out)))
    return Styled(out, len(skeleton.names))


def learn(model, pairs, name, replace):
    """pairs: (neutral clip, styled clip) as Skeleton.clip gives them. A style of that name is
    replaced if `replace`, else it is an error. Returns the bytes of the model with the style and
    what is to say about it."""
    array = (_Pair * len(pairs))(*[_Pair(neutral, styled) for neutral, styled in pairs])
    out = c_void_p()
    _check(library().panache_learn(model.content, len(model.content), array, len(pairs),
                                   _bytes(name), int(replace), byref(out)))
    size = c_size_t()
    data = library().panache_learnt_model(out, byref(size))
    content = ctypes.string_at(data, size.value)
    report = _LearntReport(struct_size=sizeof(_LearntReport))
    _check(library().panache_learnt_get_report(out, byref(report)))
    lines = _text(report.warnings or b'').splitlines()
    if report.was_tested:
        verdict = _text(library().panache_learnt_verdict(out))
        lines.insert(0, 'learnt %s (%s): %.1f cm off on the held-back part, %.1f without it' % (
            name, verdict, report.held_back_cm, report.untouched_cm))
    library().panache_learnt_destroy(out)
    return content, lines

"""What an armature does in an action, as joints of the library: evaluated, so that constraints
count."""

import json

import numpy as np
from mathutils import Quaternion, Vector

from . import actions, library

# On a baked action: the name of the action that it was made of, and what the controls were that only
# the baked one keys, [[data path, numbers], ...] in JSON. Without its keys they would stay as they
# are in its last frame.
SOURCE, UNKEYED = 'panache_source', 'panache_unkeyed'

# Rigify's generated rigs: the bones that its controls move, with the parents that they have in the
# metarig. In a generated rig many hang on mechanics instead.
RIGIFY_PARENTS = {'spine': None, 'spine.001': 'spine', 'spine.002': 'spine.001',
                  'spine.003': 'spine.002', 'spine.004': 'spine.003', 'spine.005': 'spine.004',
                  'spine.006': 'spine.005'}
for _side in ('.L', '.R'):
    RIGIFY_PARENTS.update({
        'shoulder' + _side: 'spine.003', 'upper_arm' + _side: 'shoulder' + _side,
        'forearm' + _side: 'upper_arm' + _side, 'hand' + _side: 'forearm' + _side,
        'thigh' + _side: 'spine', 'shin' + _side: 'thigh' + _side, 'foot' + _side: 'shin' + _side,
        'toe' + _side: 'foot' + _side})


def is_rigify(armature):
    """Whether the armature is a human rig that Rigify has generated."""
    bones = armature.data.bones
    return all(name in bones for name in ('ORG-spine', 'ORG-thigh.L', 'torso', 'hand_ik.L'))


class Joint:
    """A joint of the library: a bone, or the armature object itself (bone is None)."""

    def __init__(self, name, parent, bone):
        self.name, self.parent, self.bone = name, parent, bone


def joints_of(armature):
    """The object, then its bones, parents first."""
    joints = [Joint(armature.name, -1, None)]
    places = {None: 0}
    if is_rigify(armature):
        for name, parent in RIGIFY_PARENTS.items():
            bone = 'ORG-' + name
            if bone not in armature.data.bones:
                continue
            while parent is not None and parent not in places:
                parent = RIGIFY_PARENTS[parent]
            places[name] = len(joints)
            joints.append(Joint(name, places[parent], bone))
        return joints
    for bone in armature.data.bones:  # Blender lists parents first.
        places[bone.name] = len(joints)
        joints.append(Joint(bone.name, places[bone.parent.name if bone.parent else None],
                            bone.name))
    return joints


def world_matrices(context, armature, joints):
    """Where the joints are now, evaluated."""
    evaluated = armature.evaluated_get(context.evaluated_depsgraph_get())
    world = evaluated.matrix_world
    bones = evaluated.pose.bones
    return [world.copy() if joint.bone is None else world @ bones[joint.bone].matrix
            for joint in joints]


def _local(matrices, joints):
    """Rotations x y z w and translations relative to the parents, metres, without scale."""
    parts = [matrix.decompose() for matrix in matrices]
    rotations, translations = [], []
    for joint, (place, turn, _) in zip(joints, parts):
        if joint.parent >= 0:
            above, above_turn, _ = parts[joint.parent]
            back = above_turn.conjugated()
            turn, place = back @ turn, back @ (place - above)
        rotations.append((turn.x, turn.y, turn.z, turn.w))
        translations.append(tuple(place))
    return rotations, translations


def rest_joints(armature, joints):
    """Their rotations and translations at rest, as library.Skeleton takes them."""
    world = armature.matrix_world
    bones = armature.data.bones
    matrices = [world if joint.bone is None else world @ bones[joint.bone].matrix_local
                for joint in joints]
    return _local(matrices, joints)


def set_frame(scene, frame):
    """`frame` may be fractional."""
    whole = int(frame // 1)
    scene.frame_set(whole, subframe=frame - whole)


def frame_span(armature, action):
    """The first frame of an armature's action and how many it has."""
    first, last = (int(round(frame)) for frame in actions.frame_range(armature, action))
    return first, max(1, last - first + 1)


class Sampled:
    """An action of an armature as the library sees it."""

    def __init__(self, context, armature, action):
        for _ in self.read(context, armature, action):
            pass

    @classmethod
    def reading(cls, context, armature, action):
        """Makes one. A generator: it yields how much is done, 0 to 1, and returns the motion."""
        out = cls.__new__(cls)
        yield from out.read(context, armature, action)
        return out

    def read(self, context, armature, action):
        scene = context.scene
        self.joints = joints_of(armature)
        self.first, count = frame_span(armature, action)
        frame_seconds = scene.render.fps_base / scene.render.fps
        rotations, translations = [], []
        with shown_alone(context, armature, action):
            for frame in range(self.first, self.first + count):
                yield (frame - self.first) / count
                set_frame(scene, frame)
                turns, places = _local(world_matrices(context, armature, self.joints), self.joints)
                rotations.append(turns)
                translations.append(places)
            set_frame(scene, self.first)
            rest = rest_joints(armature, self.joints)
        self.skeleton = library.Skeleton(
            [joint.name for joint in self.joints], [joint.parent for joint in self.joints], *rest,
            poses=(rotations, translations))
        self.clip = library.Clip(self.skeleton, rotations, translations, frame_seconds)

    def stylize(self, model, strengths, shape, timing):
        return library.stylize(model.all, self.clip, strengths, shape=shape, timing=timing)

    def is_same(self, styled):
        """Whether a style has left the motion as it was, bit for bit."""
        return (np.array_equal(styled.rotations, self.clip.rotations) and
                np.array_equal(styled.translations, self.clip.translations))

    def world_pose(self, styled, frame):
        """The joints of a styled frame: (rotation, place) each, world, metres."""
        out = []
        for joint, (x, y, z, w), place in zip(self.joints, styled.rotations[frame].tolist(),
                                              styled.translations[frame].tolist()):
            turn, place = Quaternion((w, x, y, z)), Vector(place)
            if joint.parent >= 0:
                above_turn, above = out[joint.parent]
                turn, place = above_turn @ turn, above + above_turn @ place
            out.append((turn, place))
        return out


class shown_alone:
    """While it lasts, the armature plays `action` and nothing of its NLA; then all is as before."""

    def __init__(self, context, armature, action):
        self.scene, self.armature, self.action = context.scene, armature, action

    def __enter__(self):
        data = self.armature.animation_data
        self.before = (actions.playing(self.armature), data.use_nla, self.scene.frame_current,
                       self.scene.frame_subframe)
        stored = '[]'
        if data.action and data.action.get(SOURCE) == self.action.name:
            stored = data.action.get(UNKEYED, '[]')
        actions.play(self.armature, self.action)
        data.use_nla = False
        actions.put_back(self.armature, json.loads(stored))

    def __exit__(self, *_):
        data = self.armature.animation_data
        played, data.use_nla, frame, subframe = self.before
        actions.play_slot(self.armature, *played)
        self.scene.frame_set(frame, subframe=subframe)

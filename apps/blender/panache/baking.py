"""Writes a styled motion as a new action, and keeps the old one as a muted NLA track."""

import json

import bpy

from . import actions, controls, sampling

_SAME = 1e-6  # Evaluation error, in metres and quaternion components.


def source_action(armature):
    """The armature's action, or the one that it was baked from; None without an action."""
    data = armature.animation_data
    action = data.action if data else None
    if action is None:
        return None
    return bpy.data.actions.get(action.get(sampling.SOURCE, ''), action)


def bake(context, armature, sampled, styled, action, name):
    """Makes the styled motion the armature's action. A generator that yields its progress (0 to 1)
    and returns the action. The Blender file is unchanged until it returns."""
    plan = controls.Plan(armature, sampled.joints)
    values = {}
    if not sampled.is_same(styled):
        frames = [sampled.first + i for i in range(len(styled))]
        values, unkeyed = yield from _solve(context, armature, sampled, styled, action, plan)
    new = action.copy()
    new.name = name
    new.use_fake_user = True
    if values:
        new[sampling.UNKEYED] = json.dumps(unkeyed)
        sources = [sampled.first + f for f in styled.source_frames.tolist()]
        keeps_time = sources == frames
        if not keeps_time:
            _retime(armature, new, sources, frames)
        for target, tracks in values.items():
            _write_tracks(armature, new, target, tracks, frames, keeps_time)
    new[sampling.SOURCE] = action.name
    _keep_as_track(armature, action)
    actions.play(armature, new)
    return new


class _Track:
    """A control's transform in every frame, styled and unstyled."""

    def __init__(self, rotation):
        self.rotation = rotation  # Name of the rotation property.
        self.new = {'location': [], 'rotation': []}
        self.old = {'location': [], 'rotation': []}

    def note(self, which, bone):
        which['location'].append(tuple(bone.location))
        which['rotation'].append(tuple(getattr(bone, self.rotation)))

    def has_changed(self, kind):
        return any(abs(a - b) > _SAME for new, old in zip(self.new[kind], self.old[kind])
                   for a, b in zip(new, old))


# A generator like bake(). Returns {bone name, or None for the object: _Track} and the value of
# UNKEYED.
def _solve(context, armature, sampled, styled, action, plan):
    targets = {None: armature}
    targets.update((name, armature.pose.bones[name]) for name in plan.controls())
    tracks = {name: _Track(controls.rotation_property(target)) for name, target in targets.items()}
    with sampling.shown_alone(context, armature, action):
        solver = controls.Solver(context, armature, plan, action)
        try:
            for i, source in enumerate(styled.source_frames.tolist()):
                yield i / len(styled)
                solver.restore()
                sampling.set_frame(context.scene, sampled.first + source)
                for name, target in targets.items():
                    tracks[name].note(tracks[name].old, target)
                solver.put(sampled.world_pose(styled, i))
                for name, target in targets.items():
                    tracks[name].note(tracks[name].new, target)
                    _keep_sign(tracks[name])
        finally:
            solver.restore()
    return tracks, solver.unkeyed


# A quaternion and its negative are the same rotation: keeps the one nearer to the previous frame.
def _keep_sign(track):
    numbers = track.new['rotation']
    if track.rotation != 'rotation_quaternion' or len(numbers) < 2:
        return
    if sum(a * b for a, b in zip(numbers[-1], numbers[-2])) < 0:
        numbers[-1] = tuple(-a for a in numbers[-1])


def _write_tracks(armature, action, bone, track, frames, keeps_time):
    for kind, name in (('location', 'location'), ('rotation', track.rotation)):
        if not track.has_changed(kind):
            continue  # The retimed channels of the old action are right.
        path = actions.data_path(bone, name)
        for index in range(len(track.new[kind][0])):
            curve = actions.replace_curve(armature, action, path, index,
                                          bone or 'Object Transforms')
            _set_keys(curve, frames, [numbers[index] for numbers in track.new[kind]])


def _set_keys(curve, frames, values):
    points = curve.keyframe_points
    points.add(len(frames))
    points.foreach_set('co', [x for pair in zip(frames, values) for x in pair])
    for point in points:
        point.interpolation = 'LINEAR'
    curve.update()


# Resamples all channels to the style's tempo.
def _retime(armature, action, sources, frames):
    for curve in actions.curves(armature, action):
        values = [curve.evaluate(frame) for frame in sources]
        stepped = all(p.interpolation == 'CONSTANT' for p in curve.keyframe_points)
        while len(curve.keyframe_points):
            curve.keyframe_points.remove(curve.keyframe_points[-1], fast=True)
        _set_keys(curve, frames, values)
        if stepped:
            for point in curve.keyframe_points:
                point.interpolation = 'CONSTANT'


def _keep_as_track(armature, action):
    data = armature.animation_data
    for track in data.nla_tracks:
        if any(strip.action == action for strip in track.strips):
            return
    track = data.nla_tracks.new()
    track.name = action.name
    first, _ = sampling.frame_span(armature, action)
    actions.add_strip(track, action.name, first, armature, action)
    track.mute = True

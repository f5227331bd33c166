"""Access to actions in Blender 3.4 to 5. From 4.4 on an action has slots, each with the channels of
one data-block, and 5.0 has no Action.fcurves, so all access to channels goes through here."""

import bpy

from . import library


def _has_slots():
    # 4.3 has experimental slots under other names.
    return bpy.app.version >= (4, 4, 0)


def slot_of(armature, action):
    """The slot of `action` that animates `armature`, whether or not it plays that action: the one
    in use, else one with the same identifier or the object's name, else the first for objects.
    None without slots. Fails if all slots are for other types of data."""
    if not _has_slots() or not len(action.slots):
        return None
    data = armature.animation_data
    playing = data.action_slot if data else None
    if playing is not None and data.action == action:
        return playing
    wanted = [playing.identifier] if playing is not None else []
    wanted += [data.last_slot_identifier] if data else []
    wanted.append('OB' + armature.name)
    slots = [s for s in action.slots if s.target_id_type in ('OBJECT', 'UNSPECIFIED')]
    if not slots:
        raise library.PanacheError(
            "%s has no slot for an object, only for '%s'; expected an action of an armature" %
            (action.name, "', '".join(s.identifier for s in action.slots)))
    return next((s for name in wanted for s in slots if s.identifier == name), slots[0])


def play(armature, action):
    """Makes the armature play `action`."""
    play_slot(armature, action, slot_of(armature, action))


def playing(armature):
    """The armature's (action, slot); each may be None."""
    data = armature.animation_data
    return data.action, data.action_slot if _has_slots() else None


def play_slot(armature, action, slot):
    """Makes the armature play an action and slot returned by playing()."""
    data = armature.animation_data
    data.action = action
    if _has_slots() and action is not None:
        data.action_slot = slot


def _strips(action):
    return [strip for layer in action.layers for strip in layer.strips if strip.type == 'KEYFRAME']


def curves(armature, action):
    """The curves of `action` that animate `armature`; read-only."""
    if not _has_slots():
        return list(action.fcurves)
    slot = slot_of(armature, action)
    bags = [strip.channelbag(slot) for strip in _strips(action)] if slot is not None else []
    return [curve for bag in bags if bag is not None for curve in bag.fcurves]


def channels(armature, action):
    """The owner of these curves (`fcurves`) and their groups (`groups`); created if missing."""
    if not _has_slots():
        return action
    slot = slot_of(armature, action)
    if slot is None:
        slot = action.slots.new(id_type='OBJECT', name=armature.name)
    strips = _strips(action)
    if not strips:
        layer = action.layers[0] if len(action.layers) else action.layers.new('Layer')
        strips = [layer.strips.new(type='KEYFRAME')]
    return strips[0].channelbag(slot, ensure=True)


def replace_curve(armature, action, path, index, group):
    """A new curve without keys; removes an existing one."""
    held = channels(armature, action)
    old = held.fcurves.find(path, index=index)
    if old is not None:
        held.fcurves.remove(old)
    curve = held.fcurves.new(path, index=index)
    curve.group = held.groups.get(group) or held.groups.new(group)
    return curve


def frame_range(armature, action):
    """The first and last frame at which `action` animates `armature`."""
    if not _has_slots() or action.use_frame_range or len(action.slots) < 2:
        return tuple(action.frame_range)
    ranges = [curve.range() for curve in curves(armature, action)]
    if not ranges:
        return tuple(action.frame_range)
    return min(r[0] for r in ranges), max(r[1] for r in ranges)


def add_strip(track, name, start, armature, action):
    """Adds a strip of `action` to an NLA track of `armature`."""
    strip = track.strips.new(name, start, action)
    slot = slot_of(armature, action)
    if slot is not None:
        strip.action_slot = slot
    return strip


def data_path(bone, name):
    """The data path of a property of the bone named `bone`, or of the object if that is None."""
    return name if bone is None else 'pose.bones["%s"].%s' % (bpy.utils.escape_identifier(bone),
                                                              name)


def put_back(armature, values):
    """values: [[data path, numbers], ...]. Skips bones that no longer exist."""
    for path, numbers in values:
        owner, _, name = path.rpartition('.')
        try:
            target = armature.path_resolve(owner) if owner else armature
        except ValueError:
            continue
        setattr(target, name, numbers)

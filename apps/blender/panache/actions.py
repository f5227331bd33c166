"""Actions in every Blender from 3.4 to 5. From 4.4 on an action holds channels for several things,
each in a slot, and 5.0 has no Action.fcurves: all reads and writes of channels go through here."""

import bpy

from . import library


def _has_slots():
    # 4.3 has parts of slots as an experiment, under other names.
    return bpy.app.version >= (4, 4, 0)


def slot_of(armature, action):
    """The slot of `action` that animates `armature`, whether or not it plays that action: the one
    in use, else one of the same identifier, of the object's name, or the first for objects.
    None without slots. Fails if all slots are for things of other types."""
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
    """Makes `action` what the armature plays."""
    play_slot(armature, action, slot_of(armature, action))


def playing(armature):
    """(action, slot), each None if there is none."""
    data = armature.animation_data
    return data.action, data.action_slot if _has_slots() else None


def play_slot(armature, action, slot):
    """As playing() gives them: makes the armature play just that again."""
    data = armature.animation_data
    data.action = action
    if _has_slots() and action is not None:
        data.action_slot = slot


def _strips(action):
    return [strip for layer in action.layers for strip in layer.strips if strip.type == 'KEYFRAME']


def curves(armature, action):
    """The curves of `action` that animate `armature`, to read."""
    if not _has_slots():
        return list(action.fcurves)
    slot = slot_of(armature, action)
    bags = [strip.channelbag(slot) for strip in _strips(action)] if slot is not None else []
    return [curve for bag in bags if bag is not None for curve in bag.fcurves]


def channels(armature, action):
    """What holds these curves and their groups, as `fcurves` and `groups`; made if missing."""
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
    """A new curve without keys, in place of the one that there may be."""
    held = channels(armature, action)
    old = held.fcurves.find(path, index=index)
    if old is not None:
        held.fcurves.remove(old)
    curve = held.fcurves.new(path, index=index)
    curve.group = held.groups.get(group) or held.groups.new(group)
    return curve


def frame_range(armature, action):
    """The first and the last frame of what `action` does with `armature`."""
    if not _has_slots() or action.use_frame_range or len(action.slots) < 2:
        return tuple(action.frame_range)
    ranges = [curve.range() for curve in curves(armature, action)]
    if not ranges:
        return tuple(action.frame_range)
    return min(r[0] for r in ranges), max(r[1] for r in ranges)


def add_strip(track, name, start, armature, action):
    """A strip of `action` on an NLA track of `armature`."""
    strip = track.strips.new(name, start, action)
    slot = slot_of(armature, action)
    if slot is not None:
        strip.action_slot = slot
    return strip


def data_path(bone, name):
    """Of a property of the bone with the name `bone`, or of the object if that is None."""
    return name if bone is None else 'pose.bones["%s"].%s' % (bpy.utils.escape_identifier(bone),
                                                              name)


def put_back(armature, values):
    """values: [[data path, numbers], ...]. Those of bones that are gone are passed over."""
    for path, numbers in values:
        owner, _, name = path.rpartition('.')
        try:
            target = armature.path_resolve(owner) if owner else armature
        except ValueError:
            continue
        setattr(target, name, numbers)

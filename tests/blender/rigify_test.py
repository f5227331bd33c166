"""A generated Rigify rig: a style goes onto its controls, feet by IK and arms by FK, and the bones
that its controls move come to where the library has them."""

import os
import sys

sys.path.insert(0, os.path.dirname(__file__))
import bpy  # noqa: E402

import checks  # noqa: E402
import rigs  # noqa: E402

MOST_FEET_APART, MOST_APART = 0.02, 0.03  # Metres; a spine of four joints bends from two controls.

rigs.empty_scene()
checks.install()
rig = rigs.rigify()
walk = rig.animation_data.action
before = checks.channels(walk)
assert bpy.ops.panache.bake() == {'FINISHED'}
assert checks.channels(rig.animation_data.action) == before

rig.panache.styles.old = 1
assert bpy.ops.panache.bake() == {'FINISHED'}
baked = rig.animation_data.action
assert baked.name == 'walk (old 1)', baked.name
assert checks.channels(walk) == before
found = dict(line.split('\t') for line in rig.panache.mapping.splitlines())
assert found['leftFoot'] == 'foot.L' and found['rightHand'] == 'hand.R', found
keyed = {path.split('"')[1] for path, _ in checks.channels(baked)}
assert {'torso', 'foot_ik.L', 'foot_ik.R', 'upper_arm_fk.L', 'hand_fk.R', 'chest'} <= keyed, keyed
assert not any(name.startswith(('ORG-', 'DEF-', 'MCH-')) for name in keyed), keyed

# What the library makes of the same joints.
from panache import sampling, settings  # noqa: E402
sampled = sampling.Sampled(bpy.context, rig, walk)
styled = sampled.stylize(settings.model(), {'old': 1.0}, settings.shape(rig))
worst = {'feet': (0, ''), 'rest': (0, '')}
for i in range(styled.frame_count):
    places = sampled.world_pose(styled, i)
    heads = checks.heads(rig, sampled.first + i)
    for joint, (_, place) in zip(sampled.joints, places):
        if joint.bone is None:
            continue
        part = 'feet' if joint.name[:4] in ('foot', 'shin', 'toe.') else 'rest'
        apart = (heads[joint.bone] - place).length
        worst[part] = max(worst[part], (apart, '%s in frame %d' % (joint.name, i)))
for part, (apart, where) in worst.items():
    print('Rigify, %s: %.1f mm at most, %s' % (part, 1000 * apart, where))
assert worst['feet'][0] < MOST_FEET_APART and worst['rest'][0] < MOST_APART
print('ok')

"""A generated Rigify rig: a style goes onto its controls, feet by IK and arms by FK, and the bones
that its controls move come to where the library has them."""

import json
import os
import sys

sys.path.insert(0, os.path.dirname(__file__))
import bpy  # noqa: E402

import checks  # noqa: E402
import glb  # noqa: E402
import rigs  # noqa: E402

MOST_FEET_APART, MOST_APART = 0.02, 0.03  # Metres; a spine of four joints bends from two controls.

rigs.empty_scene()
checks.install()
rig = rigs.rigify()
rigs.add_body(rig)
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
styled = sampled.stylize(settings.model(), {'old': 1.0}, settings.options(rig))
worst = {'feet': (0, ''), 'rest': (0, '')}
for i in range(len(styled)):
    positions = sampled.world_pose(styled, i)
    heads = checks.heads(rig, sampled.first + i)
    for joint, (_, position) in zip(sampled.joints, positions):
        if joint.bone is None:
            continue
        part = 'feet' if joint.name[:4] in ('foot', 'shin', 'toe.') else 'rest'
        apart = (heads[joint.bone] - position).length
        worst[part] = max(worst[part], (apart, '%s in frame %d' % (joint.name, i)))
for part, (apart, where) in worst.items():
    print('Rigify, %s: %.1f mm at most, %s' % (part, 1000 * apart, where))
assert worst['feet'][0] < MOST_FEET_APART and worst['rest'][0] < MOST_APART

# The same rig as GLB, which the program restyles: the bones that deform the mesh hang on controls
# or on the root, and the metarig is in the file too, with the names of a person and without a mesh.
rig.animation_data.action = walk
for which, settings_of_export in {'all': {}, 'deform': {'export_def_bones': True}}.items():
    path = os.path.join(checks.folder, which + '.glb')
    bpy.ops.export_scene.gltf(filepath=path, export_format='GLB', **settings_of_export)
    told = json.loads(checks.run('info', path, '--json'))
    mapped = {j['humanoid']: j['joint'] for j in told['mapping']['joints']}
    for human, joint in {'hips': 'DEF-spine', 'chest': 'DEF-spine.003', 'head': 'DEF-spine.006',
                         'leftShoulder': 'DEF-shoulder.L', 'leftUpperArm': 'DEF-upper_arm.L',
                         'rightHand': 'DEF-hand.R', 'leftUpperLeg': 'DEF-thigh.L',
                         'rightToes': 'DEF-toe.R'}.items():
        assert mapped[human] == joint, (human, mapped[human])
    old = os.path.join(checks.folder, which + '-old.glb')
    checks.run('stylize', path, '--style', 'old=1', '--no-timing', '-o', old)
    result = glb.Glb(old)
    moments = [i / 30 for i in range(24)]
    neutral, bent = (result.positions(name, moments) for name in ('walk', 'walk (old 1)'))
    worst, moved = (0, ''), 0
    for a, b in zip(neutral, bent):
        # What the styled joints carry stays on them: nothing is torn.
        for one, other in (('DEF-spine', 'DEF-thigh.L'), ('DEF-spine', 'DEF-pelvis.R'),
                           ('DEF-spine.003', 'DEF-shoulder.R'), ('DEF-shoulder.L', 'DEF-upper_arm.L'),
                           ('DEF-spine.003', 'DEF-breast.L'), ('DEF-spine.006', 'DEF-nose'),
                           ('DEF-hand.L', 'DEF-f_index.01.L'), ('DEF-shin.R', 'DEF-foot.R')):
            apart = abs((a[one] - a[other]).length - (b[one] - b[other]).length)
            worst = max(worst, (apart, one + ' and ' + other))
        moved = max(moved, (a['DEF-spine.006'] - b['DEF-spine.006']).length)
    print('Rigify as GLB, %s: torn by %.2f mm at most, %s; head moved %.0f mm' % (
        which, 1000 * worst[0], worst[1], 1000 * moved))
    # Rigify's limbs stretch a little, by tracks of scale, which stay as they are.
    assert worst[0] < 0.003 and moved > 0.05
print('ok')

"""A rig with IK targets and poles: the style goes onto the targets, and the joints come to where
panache stylize has them."""

import os
import sys

sys.path.insert(0, os.path.dirname(__file__))
import bpy  # noqa: E402

import checks  # noqa: E402
import glb  # noqa: E402
import rigs  # noqa: E402

MOST_APART, MOST_FEET_APART = 0.001, 0.02  # Metres.
CONTROLS = ('foot_ik', 'knee_pole')
LEGS = ('UpperLeg', 'LowerLeg', 'Foot', 'Toes')

checks.run('walker', '-o', 'walk.bvh', '--seconds', '2', '--turn', '20', '--force')
rigs.empty_scene()
checks.install()
armature = rigs.plain(os.path.join(checks.folder, 'walk.bvh'))
rigs.with_ik(armature)
walk = armature.animation_data.action
walk.name = 'walk'
# The rig does walk, its feet at their targets.
strides = [checks.heads(armature, frame) for frame in range(10, 100, 10)]
for heads in strides:
    assert (heads['leftFoot'] - heads['foot_ik.L']).length < 0.005
assert (strides[0]['foot_ik.L'] - strides[-1]['foot_ik.L']).length > 0.5

bpy.ops.export_scene.gltf(filepath=os.path.join(checks.folder, 'walk.glb'), export_format='GLB')
checks.run('stylize', 'walk.glb', '--style', 'old=1', '-o', 'old.glb', '--force')
styled = glb.Glb(os.path.join(checks.folder, 'old.glb'))

before = checks.channels(walk)
assert bpy.ops.panache.bake() == {'FINISHED'}
assert checks.channels(armature.animation_data.action) == before

armature.panache.styles.old = 1
assert bpy.ops.panache.bake() == {'FINISHED'}
baked = armature.animation_data.action
assert baked.name == 'walk (old 1)', baked.name
keyed = {path.split('"')[1] for path, _ in checks.channels(baked)}
assert {'foot_ik.L', 'foot_ik.R', 'knee_pole.L', 'knee_pole.R'} <= keyed
assert not {'leftUpperLeg', 'leftLowerLeg', 'rightLowerLeg'} & keyed, keyed

first, last = checks.span(baked)
name = [n for n in styled.names if 'old 1' in n][0]
rate = bpy.context.scene.render.fps / bpy.context.scene.render.fps_base
frames = range(first, last + 1)
worst = {'legs': (0, ''), 'rest': (0, '')}
moved = 0
for frame, positions in zip(frames, styled.positions(name, [f / rate for f in frames])):
    for bone, head in checks.heads(armature, frame).items():
        if bone.startswith(CONTROLS):
            continue
        part = 'legs' if bone.endswith(LEGS) else 'rest'
        worst[part] = max(worst[part], ((head - positions[bone]).length,
                                        '%s in frame %d' % (bone, frame)))
for part, (apart, where) in worst.items():
    print('IK rig, %s: %.2f mm at most, %s' % (part, 1000 * apart, where))
assert worst['legs'][0] < MOST_FEET_APART and worst['rest'][0] < MOST_APART
print('ok')

"""GLB files of the program in Blender: one armature of all joints, one action per animation."""

import os
import sys

sys.path.insert(0, os.path.dirname(__file__))
import bpy  # noqa: E402
import numpy  # noqa: E402

import checks  # noqa: E402
import glb  # noqa: E402
import rigs  # noqa: E402

# Blender 3.4 names a type that numpy has dropped since.
if not hasattr(numpy, 'bool'):
    numpy.bool = bool

FPS = 30


def seen(name, bones, actions):
    rigs.empty_scene()
    bpy.context.scene.render.fps = FPS
    path = os.path.join(checks.folder, name)
    bpy.ops.import_scene.gltf(filepath=path)
    armatures = [o for o in bpy.data.objects if o.type == 'ARMATURE']
    empties = [o.name for o in bpy.data.objects if o.type == 'EMPTY']
    meshes = [o for o in bpy.data.objects if o.type == 'MESH' and o.find_armature()]
    assert len(armatures) == 1, (name, armatures)
    assert len(empties) <= 1, (name, empties)  # A scene's root at most.
    assert len(meshes) == 1, (name, meshes)
    assert len(armatures[0].data.bones) == bones, (name, len(armatures[0].data.bones), bones)
    assert len(bpy.data.actions) == actions, (name, list(bpy.data.actions))
    # The joints are where the file has them, in the middle of the motion.
    file = glb.Glb(path)
    seconds = 0.5
    positions = file.positions(file.names[0], [seconds])[0]
    armature = armatures[0]
    armature.animation_data.action = max(
        bpy.data.actions, key=lambda a: a.name.startswith(file.names[0]))
    for track in armature.animation_data.nla_tracks:
        track.mute = True
    heads = checks.heads(armature, int(seconds * FPS))
    apart = max((heads[b] - positions[b]).length for b in heads if b in positions)
    assert apart < 0.002, (name, apart)
    return armature


def joints_of(name):
    return len(glb.Glb(os.path.join(checks.folder, name)).json['skins'][0]['joints'])


checks.run('walker', '-o', 'walk.bvh', '--seconds', '2', '--turn', '20', '--force')
for body in ([], ['--no-body']):
    checks.run('convert', 'walk.bvh', '-o', 'walk.glb', '--force', *body)
    armature = seen('walk.glb', joints_of('walk.glb'), 1)
checks.run('stylize', 'walk.bvh', '--style', 'old=1', '-o', 'old.glb', '--force')
seen('old.glb', joints_of('old.glb'), 1)

# An FBX of Blender's own with the armature alone, as libraries of motions have them.
rigs.empty_scene()
armature = rigs.plain(os.path.join(checks.folder, 'walk.bvh'))
bpy.ops.export_scene.fbx(filepath=os.path.join(checks.folder, 'alone.fbx'),
                         object_types={'ARMATURE'}, bake_anim=True)
checks.run('convert', 'alone.fbx', '-o', 'alone.glb', '--force')
seen('alone.glb', joints_of('alone.glb'), 1)
checks.run('stylize', 'alone.fbx', '--style', 'old=1', '-o', 'both.glb', '--force')
seen('both.glb', joints_of('both.glb'), 2)

# FBX of the program, new and as a character's file with a new motion: joints are within a millimetre
# of where the GLB of the same has them, frame by frame.
def fbx_seen(name, like, motion):
    rigs.empty_scene()
    bpy.context.scene.render.fps = FPS
    bpy.ops.import_scene.fbx(filepath=os.path.join(checks.folder, name), anim_offset=0,
                             ignore_leaf_bones=False)
    armature, = [o for o in bpy.data.objects if o.type == 'ARMATURE']
    armature.animation_data.action, = [a for a in bpy.data.actions if motion in a.name]
    file = glb.Glb(os.path.join(checks.folder, like))
    name_there, = [n for n in file.names if motion in n]
    frames = list(range(0, FPS, 3))
    positions = file.positions(name_there, [f / FPS for f in frames])
    shared = set(checks.heads(armature, 0)) & set(positions[0])
    assert len(shared) > 15, (name, shared)
    for frame, there in zip(frames, positions):
        here = checks.heads(armature, frame)
        worst = max(shared, key=lambda j: (here[j] - there[j]).length)
        apart = (here[worst] - there[worst]).length
        assert apart < 0.001, (name, frame, worst, here[worst], there[worst])


checks.run('walker', '-o', 'walk30.bvh', '--seconds', '2', '--turn', '20', '--fps', str(FPS), '--force')
checks.run('convert', 'walk30.bvh', '-o', 'walk30.fbx', '--force')
checks.run('convert', 'walk30.bvh', '-o', 'walk30.glb', '--force')
fbx_seen('walk30.fbx', 'walk30.glb', 'walk30')
checks.run('stylize', 'walk30.fbx', '--style', 'old=1', '-o', 'old30.fbx', '--no-timing', '--force')
checks.run('stylize', 'walk30.glb', '--style', 'old=1', '-o', 'old30.glb', '--no-timing', '--force')
fbx_seen('old30.fbx', 'old30.glb', 'old 1')
# A file of Blender's own, in which the program writes.
rigs.empty_scene()
bpy.context.scene.render.fps = FPS
rigs.plain(os.path.join(checks.folder, 'walk30.bvh'))
bpy.ops.export_scene.fbx(filepath=os.path.join(checks.folder, 'own.fbx'), bake_anim=True,
                         object_types={'ARMATURE'}, add_leaf_bones=False,
                         bake_anim_simplify_factor=0)
checks.run('stylize', 'own.fbx', '--style', 'old=1', '-o', 'own-old.fbx', '--no-timing', '--force')
checks.run('convert', 'own-old.fbx', '-o', 'own-old.glb', '--force')
fbx_seen('own-old.fbx', 'own-old.glb', 'old 1')
print('ok')

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
    places = file.places(file.names[0], [seconds])[0]
    armature = armatures[0]
    armature.animation_data.action = max(
        bpy.data.actions, key=lambda a: a.name.startswith(file.names[0]))
    for track in armature.animation_data.nla_tracks:
        track.mute = True
    heads = checks.heads(armature, int(seconds * FPS))
    apart = max((heads[b] - places[b]).length for b in heads if b in places)
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

# A GLB as FBX, as docs/formats.md says: within a millimetre and a frame.
bpy.ops.wm.read_homefile(use_empty=True)
bpy.context.scene.render.fps = 30
bpy.ops.import_scene.gltf(filepath=os.path.join(checks.folder, 'old.glb'))
bpy.ops.export_scene.fbx(filepath=os.path.join(checks.folder, 'old.fbx'), add_leaf_bones=False, bake_anim_simplify_factor=0)
checks.run('convert', 'old.fbx', '-o', 'back.glb', '--force')
before = glb.Glb(os.path.join(checks.folder, 'old.glb'))
after = glb.Glb(os.path.join(checks.folder, 'back.glb'))
moments = [0.2 * i for i in range(7)]  # Whole frames, which Blender's exporter samples.
name = next(n for n in after.names if before.names[0] in n)
for a, b in zip(before.places(before.names[0], moments), after.places(name, moments)):
    shared = set(a) & set(b)
    assert len(shared) > 15, shared
    worst = max(shared, key=lambda j: (a[j] - b[j]).length)
    assert (a[worst] - b[worst]).length < 0.001, (worst, a[worst], b[worst])
print('ok')

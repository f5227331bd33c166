"""Rigs with a walk, made by script: plain, with IK targets and poles, and Rigify's."""

import math

import bpy
from mathutils import Matrix, Vector

# Debian's Blender opens files in a way that its Python has given up.
import builtins
_open = builtins.open
builtins.open = lambda file, mode='r', *rest, **named: _open(file, mode.replace('U', ''), *rest,
                                                             **named)


def empty_scene(fps=30):
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.context.scene.render.fps = fps


def activate(thing):
    bpy.ops.object.select_all(action='DESELECT')
    thing.select_set(True)
    bpy.context.view_layer.objects.active = thing


def plain(bvh):
    """A walk as Blender reads it from a BVH file, a bone for each joint."""
    bpy.ops.import_anim.bvh(filepath=bvh, update_scene_fps=True, update_scene_duration=True,
                            rotate_mode='QUATERNION')
    armature = bpy.context.object
    add_body(armature)
    return armature


def add_body(armature):
    """A triangle for each bone, so that exporters see a skin."""
    mesh = bpy.data.meshes.new('Body')
    body = bpy.data.objects.new('Body', mesh)
    bpy.context.collection.objects.link(body)
    bones = [bone for bone in armature.data.bones if bone.use_deform]
    corners = [Vector((0, 0, 0)), Vector((.05, 0, 0)), Vector((0, .05, 0))]
    mesh.from_pydata([bone.head_local + corner for bone in bones for corner in corners], [],
                     [(3 * i, 3 * i + 1, 3 * i + 2) for i in range(len(bones))])
    for i, bone in enumerate(bones):
        body.vertex_groups.new(name=bone.name).add([3 * i, 3 * i + 1, 3 * i + 2], 1, 'REPLACE')
    body.parent = armature
    body.modifiers.new('Armature', 'ARMATURE').object = armature
    activate(armature)


def with_ik(armature, leg=('UpperLeg', 'LowerLeg', 'Foot')):
    """The same walk on legs that follow IK targets and poles, which carry the keys instead."""
    scene = bpy.context.scene
    action = armature.animation_data.action
    first, last = (int(f) for f in action.frame_range)
    sides = {'left': '.L', 'right': '.R'}
    bpy.ops.object.mode_set(mode='EDIT')
    edit = armature.data.edit_bones
    for side, end in sides.items():
        foot, shin, thigh = (edit[side + leg[i]] for i in (2, 1, 0))
        # A leg that rests quite straight is none that IK can bend.
        shin.head += Vector((0, -0.02, 0))
        thigh.tail = shin.head
        target = edit.new('foot_ik' + end)
        target.head, target.tail, target.roll = foot.head, foot.tail, foot.roll
        target.use_deform = False
        pole = edit.new('knee_pole' + end)
        pole.head = shin.head + Vector((0, -0.6, 0))
        pole.tail = pole.head + Vector((0, -0.1, 0))
        pole.use_deform = False
    bpy.ops.object.mode_set(mode='POSE')
    # Where feet and knees are in the walk, before they follow.
    seen = []
    for frame in range(first, last + 1):
        scene.frame_set(frame)
        bones = armature.pose.bones
        seen.append({side: (bones[side + leg[2]].matrix.copy(), _ahead(armature, side, leg),
                            bones[side + leg[1]].head.copy()) for side in sides})
    for side, end in sides.items():
        for name in leg:
            _remove_channels(action, side + name)
            bone = armature.pose.bones[side + name]
            bone.matrix_basis = Matrix()
        shin = armature.pose.bones[side + leg[1]]
        ik = shin.constraints.new('IK')
        ik.target, ik.subtarget, ik.chain_count = armature, 'foot_ik' + end, 2
        ik.pole_target, ik.pole_subtarget = armature, 'knee_pole' + end
        ik.iterations = 500
        turn = armature.pose.bones[side + leg[2]].constraints.new('COPY_ROTATION')
        turn.target, turn.subtarget = armature, 'foot_ik' + end
    for frame, legs in enumerate(seen, first):
        scene.frame_set(frame)
        for side, end in sides.items():
            foot, ahead, _ = legs[side]
            _key(armature.pose.bones['foot_ik' + end], foot, frame)
            pole = armature.pose.bones['knee_pole' + end]
            _key(pole, Matrix.Translation(ahead) @
                 pole.bone.matrix_local.to_3x3().to_4x4(), frame)
    for side in sides:
        bent = max(range(len(seen)), key=lambda i: _bend(seen[i][side]))
        _find_pole_angle(armature, side, leg, first + bent, seen[bent][side][2])
    bpy.ops.object.mode_set(mode='OBJECT')
    return armature


# The nearer ankle and pole are, the more the knee is bent.
def _bend(leg):
    foot, ahead, knee = leg
    return -(foot.translation - ahead).length


# Half a metre in front of the knee, in the plane of the leg.
def _ahead(armature, side, leg):
    bones = armature.pose.bones
    hip, knee, foot = (bones[side + name].matrix.translation for name in leg)
    along = (foot - hip).normalized()
    bend = (knee - hip) - along * (knee - hip).dot(along)
    toes = bones[side + 'Toes'].matrix.translation - foot
    if bend.length < 0.02:
        bend = toes - along * toes.dot(along)
    return knee + 0.6 * bend.normalized()


# Finds the angle of the pole against the bones' own axes at which the knee is where it was.
def _find_pole_angle(armature, side, leg, frame, knee):
    bone = armature.pose.bones[side + leg[1]]
    ik = next(c for c in bone.constraints if c.type == 'IK')
    bpy.context.scene.frame_set(frame)

    def off(degrees):
        ik.pole_angle = math.radians(degrees)
        bpy.context.view_layer.update()
        return (bone.head - knee).length

    around = min(range(-180, 180, 10), key=off)
    ik.pole_angle = math.radians(min((around + d / 4 for d in range(-40, 41)), key=off))


def _remove_channels(action, bone):
    for curve in [c for c in action.fcurves if '"%s"' % bone in c.data_path]:
        action.fcurves.remove(curve)


def _key(bone, matrix, frame):
    bone.rotation_mode = 'QUATERNION'
    bone.matrix = matrix
    bpy.context.view_layer.update()
    bone.keyframe_insert('location', frame=frame)
    bone.keyframe_insert('rotation_quaternion', frame=frame)


def rigify(frames=24):
    """Rigify's human, generated, with a walk on its controls: feet by IK, arms by FK."""
    bpy.ops.preferences.addon_enable(module='rigify')
    bpy.ops.object.armature_human_metarig_add()
    metarig = bpy.context.object
    bpy.ops.pose.rigify_generate()
    rig = next(o for o in bpy.data.objects if o.type == 'ARMATURE' and o != metarig)
    metarig.hide_set(True)
    activate(rig)
    bones = rig.pose.bones
    for side in ('.L', '.R'):
        bones['upper_arm_parent' + side]['IK_FK'] = 1.0
        bones['thigh_parent' + side]['IK_Stretch'] = 0.0
    rig.animation_data_create()
    rig.animation_data.action = bpy.data.actions.new('walk')
    for frame in range(1, frames + 1):
        phase = 2 * math.pi * frame / 30
        _move(bones['torso'], frame, y=-0.035 * frame, z=-0.06 + 0.015 * math.cos(2 * phase))
        for side, sign in (('.L', 1), ('.R', -1)):
            stride = phase + (0 if sign > 0 else math.pi)
            lift = max(0.0, math.sin(stride))
            _move(bones['foot_ik' + side], frame, y=-0.035 * frame + 0.25 * math.cos(stride),
                  z=0.12 * lift)
            _turn(bones['upper_arm_fk' + side], frame, (0.4 * math.cos(stride), 0, 0))
            _turn(bones['forearm_fk' + side], frame, (0.4, 0, 0))
        _turn(bones['chest'], frame, (0, 0.1 * math.cos(phase), 0))
    return rig


# Moves a bone in the armature's space, in the axes that its rest has there.
def _move(bone, frame, x=0.0, y=0.0, z=0.0):
    bone.location = bone.bone.matrix_local.to_3x3().inverted() @ Vector((x, y, z))
    bone.keyframe_insert('location', frame=frame)


def _turn(bone, frame, angles):
    if bone.rotation_mode == 'QUATERNION':
        from mathutils import Euler
        bone.rotation_quaternion = Euler(angles).to_quaternion()
        bone.keyframe_insert('rotation_quaternion', frame=frame)
    else:
        bone.rotation_euler = angles
        bone.keyframe_insert('rotation_euler', frame=frame)

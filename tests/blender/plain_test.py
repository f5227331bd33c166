"""A plain rig: baked in Blender it is what panache stylize makes of its GLB, at strength 0 it is
what it was, and the style learnt from two of its actions is a slider."""

import importlib
import os
import sys

sys.path.insert(0, os.path.dirname(__file__))
import bpy  # noqa: E402

import checks  # noqa: E402
import glb  # noqa: E402
import rigs  # noqa: E402

MOST_APART = 0.001  # Metres.

checks.run('walker', '-o', 'walk.bvh', '--seconds', '2', '--turn', '20', '--force')
rigs.empty_scene()
checks.install()
armature = rigs.plain(os.path.join(checks.folder, 'walk.bvh'))
walk = armature.animation_data.action
walk.name = 'walk'

bpy.ops.export_scene.gltf(filepath=os.path.join(checks.folder, 'walk.glb'), export_format='GLB')
checks.run('stylize', 'walk.glb', '--style', 'old=1', '-o', 'old.glb', '--force')
styled = glb.Glb(os.path.join(checks.folder, 'old.glb'))


def compare(glb_file, word, action):
    """A baked action is the motion of a GLB whose name holds `word`."""
    first, last = checks.span(action)
    name = [n for n in glb_file.names if word in n][0]
    rate = bpy.context.scene.render.fps / bpy.context.scene.render.fps_base
    frames = range(first, last + 1)
    in_glb = glb_file.positions(name, [frame / rate for frame in frames])
    worst = (0, '')
    for frame, positions in zip(frames, in_glb):
        for bone, head in checks.heads(armature, frame).items():
            worst = max(worst, ((head - positions[bone]).length, '%s in frame %d' % (bone, frame)))
    print('plain rig, %s: %.2f mm at most between Blender and panache stylize, %s' % (
        word, 1000 * worst[0], worst[1]))
    assert worst[0] < MOST_APART, worst


# Strength 0: a new action with every channel as it was.
before = checks.channels(walk)
assert bpy.ops.panache.bake() == {'FINISHED'}
baked = armature.animation_data.action
assert baked != walk and baked.name == 'walk (no style)', baked.name
assert checks.channels(baked) == before
assert checks.channels(walk) == before

# Old: from the same source, whatever was baked before.
armature.panache.styles.old = 1
assert bpy.ops.panache.bake() == {'FINISHED'}
baked = armature.animation_data.action
assert baked.name == 'walk (old 1)', baked.name
assert checks.channels(walk) == before, 'the old action has changed'
tracks = armature.animation_data.nla_tracks
assert [(t.name, t.mute, t.strips[0].action) for t in tracks] == [('walk', True, walk)]
compare(styled, 'old 1', baked)
assert armature.panache.known.endswith('%')
assert 'leftFoot\tleftFoot' in armature.panache.mapping, armature.panache.mapping

# A person, of a word or a number, and another energy, without a style.
settings = importlib.import_module('panache.settings')
armature.panache.styles.old = 0
for text, seed, energy in (('mara', 'mara', 0.5), (' 7 ', '7', 1)):
    armature.panache.person, armature.panache.variety = text, 1.5
    armature.panache.energy = energy
    armature.animation_data.action = walk
    assert settings.person(armature) == seed
    assert bpy.ops.panache.bake() == {'FINISHED'}
    moved = armature.animation_data.action
    assert moved.name == ('walk (person mara, energy 0.5)' if seed == 'mara' else
                          'walk (person 7)'), moved.name
    assert checks.channels(moved) != before
    checks.run('stylize', 'walk.glb', '--person', str(seed), '--variety', '1.5', '--energy',
               str(energy), '-o', 'person.glb', '--force')
    compare(glb.Glb(os.path.join(checks.folder, 'person.glb')), 'person', moved)
for text in (' ', ''):
    armature.panache.person = text
    assert settings.person(armature) is None
armature.panache.variety = armature.panache.styles.old = 1

# A style learnt from the two actions.
armature.panache.neutral, armature.panache.styled = walk, baked
armature.panache.style_name = 'limp'
assert bpy.ops.panache.learn() == {'FINISHED'}
assert 'limp' in armature.panache.styles.bl_rna.properties
armature.animation_data.action = walk
armature.panache.styles.old, armature.panache.styles.limp = 0, 1

# The panel lists the styles by their groups, the learnt one under none; of a group that is folded,
# the sliders that are not at 0.
groups = settings.model().groups
assert sorted(sum(groups.values(), [])) == sorted(settings.model().styles)
assert groups[''][-1] == 'limp', groups
few = len(settings.model().styles) <= settings.MANY_STYLES
for i, group in enumerate(groups):
    is_open = getattr(armature.panache.groups, settings.property_of_group(group))
    assert is_open == (few or i == 0 or group == ''), group
assert settings.sliders_shown(armature.panache, groups[''], True) == groups['']
assert settings.sliders_shown(armature.panache, groups[''], False) == ['limp']

assert bpy.ops.panache.bake() == {'FINISHED'}
assert armature.animation_data.action.name == 'walk (limp 1)'
captured = checks.channels(armature.animation_data.action)
assert captured != before

# A style on its other side, whose slider shows while it is moved.
assert settings.other_side('to the left') == 'to the right'
assert not settings.has_side_shown(armature.panache, 'limp')
armature.animation_data.action = walk
armature.panache.sides.limp = armature.panache.sides.old = -1
assert settings.has_side_shown(armature.panache, 'limp')
assert settings.sides(armature) == {'limp': -1}
assert bpy.ops.panache.bake() == {'FINISHED'}
assert checks.channels(armature.animation_data.action) not in (captured, before)
armature.panache.sides.limp = armature.panache.sides.old = 1

# And one from the styled action alone.
armature.panache.neutral = None
armature.panache.style_name = 'alone'
assert bpy.ops.panache.learn() == {'FINISHED'}
armature.panache.styles.limp, armature.panache.styles.alone = 0, 1
armature.animation_data.action = walk
assert bpy.ops.panache.bake() == {'FINISHED'}
assert armature.animation_data.action.name == 'walk (alone 1)'
assert checks.channels(armature.animation_data.action) != before
print('ok')

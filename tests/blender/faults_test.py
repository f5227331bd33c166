"""What goes wrong in a user's hands: models that cannot be read, names that are taken or that
Blender takes none like, a preview during a render, across undo and loading, bones that go."""

import os
import sys

sys.path.insert(0, os.path.dirname(__file__))
import bpy  # noqa: E402

import checks  # noqa: E402
import rigs  # noqa: E402


def preferences():
    return bpy.context.preferences.addons['panache'].preferences


def sliders():
    return set(bpy.types.Object.bl_rna.properties['panache'].fixed_type.properties['styles']
               .fixed_type.properties.keys()) - {'rna_type', 'name'}


def error_of(operator):
    """The sentence with which an operator fails."""
    try:
        operator()
    except RuntimeError as error:
        return str(error)
    raise AssertionError('%s does not fail' % operator)


def largest_turn(armature):
    """By how much a bone turns most in the pose that is shown, degrees."""
    return max(abs(b.matrix_basis.to_quaternion().angle) for b in armature.pose.bones) * 57.3


checks.run('walker', '-o', 'walk.bvh', '--seconds', '1', '--force')
rigs.empty_scene()
checks.install()
armature = rigs.plain(os.path.join(checks.folder, 'walk.bvh'))
walk = armature.animation_data.action
walk.name = 'walk'
from panache import actions, library, preview, settings  # noqa: E402
shipped = sliders()

# A wrong model in the preferences: the shipped one is in use, at the next start too.
torn = os.path.join(checks.folder, 'torn.safetensors')
with open(settings.SHIPPED, 'rb') as file:
    content = file.read()
with open(torn, 'wb') as file:
    file.write(content[:len(content) // 2])
for wrong in (torn, os.path.join(checks.folder, 'none.safetensors'), checks.folder, 'walk.bvh'):
    preferences().model = wrong
    assert sliders() == shipped
    assert os.path.basename(wrong) in settings._problem, settings._problem
    assert settings._problem.endswith('; the shipped model is in use')
    bpy.ops.preferences.addon_disable(module='panache')
    # The preferences of a start are there before the add-on is.
    import addon_utils
    entry = bpy.context.preferences.addons.new()
    entry.module = 'panache'
    assert bpy.ops.preferences.addon_enable(module='panache') == {'FINISHED'}
    preferences().model = wrong
    settings.unregister()
    settings.register()
    assert sliders() == shipped and settings._problem
preferences().model = ''
assert not settings._problem
assert bpy.ops.panache.bake() == {'FINISHED'}
armature.animation_data.action = walk

# A model without persons: it says so, and the rest goes on.
armature.panache.person = 'mara'
assert settings.person_problem(armature) == '' and settings.person(armature) == 'mara'
preferences().model = os.path.join(os.path.dirname(__file__), '../../models/smith2019.safetensors')
assert settings.person_problem(armature).startswith('the model has no persons; expected ')
assert settings.person(armature) is None
armature.panache.styles.angry = 1
armature.panache.preview = True
assert armature.panache.preview, armature.panache.notes
assert bpy.ops.panache.bake() == {'FINISHED'}
assert armature.animation_data.action.name == 'walk (angry 1)'
armature.panache.preview = False
armature.panache.person = ''
assert settings.person_problem(armature) == ''
preferences().model = ''
armature.panache.styles.angry = 0
armature.animation_data.action = walk

# A style is learnt from an action in it.
assert 'expected an action in the style' in error_of(bpy.ops.panache.learn)

# A learnt style does not replace a shipped one, in any case of letters.
armature.panache.neutral = armature.panache.styled = walk
for name in ('old', 'OLD'):
    armature.panache.style_name = name
    said = error_of(bpy.ops.panache.learn)
    assert "style name '%s': the model has a style of that name; choose another" % name in said, said
assert not os.path.exists(settings.learnt_path())

# A file that cannot be written is an error, and leaves what there was.
armature.panache.style_name = 'limp'
armature.panache.styles.old = 1
bpy.ops.panache.bake()
armature.panache.styled = armature.animation_data.action
armature.animation_data.action = walk
assert bpy.ops.panache.learn() == {'FINISHED'}
with open(settings.learnt_path(), 'rb') as file:
    learnt = file.read()
replace = os.replace


def disk_full(*_):
    raise OSError(28, 'No space left on device', settings.learnt_path())


os.replace = disk_full
assert 'No space left' in error_of(bpy.ops.panache.learn)
os.replace = replace
with open(settings.learnt_path(), 'rb') as file:
    assert file.read() == learnt
assert os.listdir(os.path.dirname(settings.learnt_path())) == ['styles.safetensors']

# Names that Blender takes no property of. One's own style is replaced.
own = ('_limp', 'x' * 60, 'Limp', 'get', 'h\xfcpf "er"')
for name in own:
    armature.panache.style_name = name
    assert bpy.ops.panache.learn() == {'FINISHED'}, name
assert set(settings.model().styles) == shipped | {'limp'} | set(own) - {'Limp'}
assert len(sliders()) == len(shipped) + 5
setattr(armature.panache.styles, settings.property_of('_limp'), 1)
armature.panache.styles.old = 0
assert settings.strengths(armature) == {'_limp': 1}
assert bpy.ops.panache.bake() == {'FINISHED'}
assert armature.animation_data.action.name == 'walk (_limp 1)'
armature.animation_data.action = walk

# Styles that were learnt are not lost where they are not in use.
preferences().model = ''
armature.panache.style_name = 'new'
assert 'holds styles that were learnt before' in error_of(bpy.ops.panache.learn)
preferences().model = settings.learnt_path()

# Without preferences, as when a script registers the add-on.
addons = bpy.context.preferences.addons
addons.remove(addons['panache'])
armature.panache.style_name = 'new'
assert bpy.ops.panache.learn.poll()
settings.reload_styles()
assert sliders() == shipped
os.remove(settings.learnt_path())
assert bpy.ops.panache.learn() == {'FINISHED'}
assert 'new' in sliders()
os.remove(settings.learnt_path())
settings._path = ''
settings.reload_styles()
print('models and names', flush=True)

# A bone's name of any kind; one that no key holds comes back after the preview.
odd = 'a "b" \\ c.\td'
bpy.ops.object.mode_set(mode='EDIT')
bone = armature.data.edit_bones.new(odd)
bone.head, bone.tail = (0, 0, 1), (0, 0, 1.2)
bone.parent = armature.data.edit_bones['head']
bpy.ops.object.mode_set(mode='OBJECT')
turned = (0.8, 0.6, 0, 0)
armature.pose.bones[odd].rotation_quaternion = turned
scene = bpy.context.scene
scene.frame_set(10)
plain = {b.name: b.matrix_basis.copy() for b in armature.pose.bones}


def is_plain():
    return all((a - b).length < 1e-5 for bone in armature.pose.bones
               for a, b in zip(bone.matrix_basis, plain[bone.name]))


armature.panache.styles.old = 1
armature.panache.preview = True
assert armature.panache.preview, armature.panache.notes
assert not is_plain()
scene.frame_set(11)
scene.frame_set(10)
assert not is_plain()

# Checking the rig sees the action, not the preview, and the preview goes on.
assert bpy.ops.panache.look() == {'FINISHED'}
assert not is_plain()

# A render shows the action, and leaves the preview alone.
frames, puts = [], []


def look(scene, _depsgraph=None):
    if preview._rendering:
        frames.append(scene.frame_current)


put = preview._state.solver.put
preview._state.solver.put = lambda wanted: puts.append(preview._rendering) or put(wanted)
bpy.app.handlers.frame_change_post.append(look)
scene.render.engine = 'CYCLES'
scene.cycles.samples, scene.cycles.use_denoising = 1, False
scene.render.resolution_x = scene.render.resolution_y = 8
scene.render.filepath = os.path.join(checks.folder, 'picture')
scene.frame_start, scene.frame_end = 9, 11
scene.camera = bpy.data.objects.new('Camera', bpy.data.cameras.new('Camera'))
scene.collection.objects.link(scene.camera)
bpy.ops.render.render(animation=True)
assert frames == [9, 10, 11] and not any(puts), (frames, puts)
bpy.app.handlers.frame_change_post.remove(look)
preview._state.solver.put = put
scene.frame_set(10)
assert not is_plain()

# Off: all is as it was.
armature.panache.preview = False
assert is_plain() and preview.SHOWN not in armature

# Another armature's preview ends this one's, and a script may set either.
armature.panache.preview = True
other = armature.copy()
other.animation_data.action = walk
scene.collection.objects.link(other)
other.panache.preview = False
other.panache.preview = True
assert not armature.panache.preview and is_plain()
bpy.data.objects.remove(other)
scene.frame_set(11)
scene.frame_set(10)

# A bone goes while it is shown.
armature.panache.preview = True
bpy.ops.object.mode_set(mode='EDIT')
edit = armature.data.edit_bones
edit.remove(edit[odd])
bpy.ops.object.mode_set(mode='OBJECT')
scene.frame_set(12)
scene.frame_set(10)
armature.panache.preview = False
assert is_plain()

# A file that was saved during a preview shows its action when it is opened.
bpy.ops.object.mode_set(mode='POSE')
bpy.ops.object.mode_set(mode='OBJECT')
hips = armature.pose.bones[0]
for curve in [c for c in walk.fcurves if '"neck"' in c.data_path]:
    walk.fcurves.remove(curve)
armature.pose.bones['neck'].rotation_quaternion = turned
scene.frame_set(10)
plain = {b.name: b.matrix_basis.copy() for b in armature.pose.bones}
armature.panache.preview = True
assert not is_plain()
saved = os.path.join(checks.folder, 'saved.blend')
name = armature.name
bpy.ops.wm.save_as_mainfile(filepath=saved)
bpy.ops.wm.open_mainfile(filepath=saved)
armature = bpy.data.objects[name]
assert not armature.panache.preview and preview.SHOWN not in armature and preview._state is None
assert is_plain()
bpy.context.scene.frame_set(11)

# Disabled during a preview, nothing is left behind.
armature.panache.preview = True
bpy.ops.preferences.addon_disable(module='panache')
assert not [h for h in bpy.app.handlers.frame_change_post if h.__module__.startswith('panache')]
print('ok')

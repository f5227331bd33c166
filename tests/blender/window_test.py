"""The panel in a window: sliders show the style at once, Bake can be undone and redone. Leaves
pictures in the folder PANACHE_PICTURES."""

import os
import subprocess
import sys
import traceback

sys.path.insert(0, os.path.dirname(__file__))
import bpy  # noqa: E402

import checks  # noqa: E402
import rigs  # noqa: E402

PICTURES = os.environ.get('PANACHE_PICTURES', checks.folder)


def view():
    window = bpy.context.window_manager.windows[0]
    area = max((a for a in window.screen.areas if a.type == 'VIEW_3D'), key=lambda a: a.width)
    region = next(r for r in area.regions if r.type == 'WINDOW')
    return {'window': window, 'area': area, 'region': region}


def picture(name):
    with bpy.context.temp_override(**view()):
        bpy.ops.wm.redraw_timer(type='DRAW_WIN_SWAP', iterations=2)
        bpy.ops.screen.screenshot(filepath=os.path.join(PICTURES, name + '.png'))


def click(x, y):
    """With a real mouse, from the top left corner of the screen."""
    subprocess.run(['xdotool', 'mousemove', str(x), str(y)], check=True)
    yield
    subprocess.run(['xdotool', 'click', '1'], check=True)
    yield


def armature():
    return next(o for o in bpy.data.objects if o.type == 'ARMATURE')


def active_action():
    return armature().animation_data.action.name


def hips():
    return checks.heads(armature(), bpy.context.scene.frame_current)


def steps():
    checks.run('walker', '-o', 'walk.bvh', '--seconds', '2', '--force')
    checks.install()
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    rig = rigs.plain(os.path.join(checks.folder, 'walk.bvh'))
    rig.animation_data.action.name = 'walk'
    where = view()
    where['area'].spaces[0].show_region_ui = True
    with bpy.context.temp_override(**where):
        bpy.ops.view3d.view_axis(type='RIGHT')
        bpy.context.scene.frame_set(60)
        bpy.ops.view3d.view_selected()
    bpy.ops.ed.undo_push(message='A walk')
    yield
    # The tabs of the sidebar: Panache stands below those of Blender.
    yield from click(300, 500)  # Away with Blender's greeting.
    yield from click(1044, 252)
    subprocess.run(['xdotool', 'mousemove', '300', '500'], check=True)
    yield
    picture('1-open')
    before = {name: position.copy() for name, position in seen().items()}
    armature().panache.preview = True
    armature().panache.styles.old = 1
    yield
    picture('2-slider')
    shown = seen()
    assert max((shown[n] - before[n]).length for n in before) > 0.03, 'the preview shows no style'
    assert active_action() == 'walk'
    yield from cancelled_bake(before)
    with bpy.context.temp_override(**view()):
        bpy.ops.panache.bake('EXEC_DEFAULT', True)
    yield
    picture('3-baked')
    assert active_action() == 'walk (old 1)'
    baked = seen()
    with bpy.context.temp_override(**view()):
        bpy.ops.ed.undo()
    yield
    assert active_action() == 'walk', active_action()
    assert 'walk (old 1)' not in bpy.data.actions
    assert not armature().animation_data.nla_tracks
    now = seen()
    assert max((now[n] - before[n]).length for n in before) < 1e-4, 'undo leaves a pose behind'
    with bpy.context.temp_override(**view()):
        bpy.ops.ed.redo()
    yield
    assert active_action() == 'walk (old 1)', active_action()
    now = seen()
    assert max((now[n] - baked[n]).length for n in baked) < 1e-4
    assert armature().animation_data.nla_tracks[0].mute
    yield from preview_across_undo()
    print('ok', flush=True)


def cancelled_bake(before):
    """Esc ends a bake of many frames, and nothing is changed; left alone, it comes to its end."""
    scene = bpy.context.scene
    walk, frame = bpy.data.actions['walk'], scene.frame_current
    armature().panache.preview = False
    walk.frame_range, walk.use_frame_range = (1, 3000), True  # It takes a while.
    names = [action.name for action in bpy.data.actions]
    with bpy.context.temp_override(**view()):
        assert bpy.ops.panache.bake('INVOKE_DEFAULT') == {'RUNNING_MODAL'}
    for _ in range(3):
        yield
    assert scene.frame_current != frame, 'nothing is being baked'
    subprocess.run(['xdotool', 'key', 'Escape'], check=True)
    yield
    yield
    assert [action.name for action in bpy.data.actions] == names
    assert active_action() == 'walk' and scene.frame_current == frame
    assert not armature().animation_data.nla_tracks
    now = seen()
    assert max((now[n] - before[n]).length for n in before) < 1e-4, 'a cancelled bake left a pose'
    walk.use_frame_range = False
    with bpy.context.temp_override(**view()):
        assert bpy.ops.panache.bake('INVOKE_DEFAULT') == {'RUNNING_MODAL'}
    for _ in range(60):
        yield
        if active_action() != 'walk':
            break
    assert active_action() == 'walk (old 1)', 'a bake from its button never ends'
    with bpy.context.temp_override(**view()):
        bpy.ops.ed.undo()
    yield
    assert active_action() == 'walk'
    armature().panache.styles.old = 1  # Undone as well.


def preview_across_undo():
    """Undo makes bones anew, and its steps hold what the preview shows: a bone without keys is where
    it was all the same."""
    turned = (0.8, 0.6, 0, 0)
    scene = bpy.context.scene

    def neck():
        return tuple(round(x, 4) for x in armature().pose.bones['neck'].rotation_quaternion)

    def undo_or_redo(operator):
        with bpy.context.temp_override(**view()):
            operator()

    walk = bpy.data.actions['walk']
    armature().animation_data.action = walk
    for curve in [c for c in walk.fcurves if '"neck"' in c.data_path]:
        walk.fcurves.remove(curve)
    armature().pose.bones['neck'].rotation_quaternion = turned
    scene.frame_set(60)
    assert neck() == turned
    bpy.ops.ed.undo_push(message='A neck')
    yield
    armature().panache.preview = True
    assert neck() != turned
    bpy.ops.ed.undo_push(message='Preview')
    yield
    for _ in range(3):
        undo_or_redo(bpy.ops.ed.undo)
        yield
        assert not armature().panache.preview and neck() == turned, neck()
        bpy.context.scene.frame_set(61)
        assert neck() == turned, neck()
        undo_or_redo(bpy.ops.ed.redo)
        yield
        assert armature().panache.preview
        bpy.context.scene.frame_set(61)
        assert neck() != turned
    armature().panache.styles.old = 1.5
    assert neck() != turned
    armature().panache.preview = False
    assert neck() == turned, neck()


def seen():
    """Where the bones begin as they are shown now."""
    rig = armature()
    shown = rig.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return {b.name: (shown.matrix_world @ b.head).copy() for b in shown.pose.bones}


run = steps()


def tick():
    try:
        next(run)
        return 0.5
    except StopIteration:
        pass
    except Exception:
        traceback.print_exc()
    bpy.ops.wm.quit_blender()


bpy.app.timers.register(tick, first_interval=1.0)

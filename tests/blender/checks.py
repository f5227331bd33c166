"""What the tests in Blender share: the add-on installed from its zip, and what is compared."""

import subprocess
import sys

import bpy

program, library_zip, folder = sys.argv[sys.argv.index('--') + 1:][:3]



def install():
    """As a user would: from the zip."""
    bpy.ops.preferences.addon_install(filepath=library_zip, overwrite=True)
    bpy.ops.preferences.addon_enable(module='panache')


def run(*arguments):
    done = subprocess.run([program, *arguments], cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def heads(armature, frame):
    """{bone: where it begins}, world, evaluated."""
    bpy.context.scene.frame_set(frame)
    seen = armature.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return {b.name: seen.matrix_world @ b.head for b in seen.pose.bones}


def channels(action):
    return {(c.data_path, c.array_index): [tuple(p.co) for p in c.keyframe_points]
            for c in action.fcurves}


def span(action):
    return [int(round(f)) for f in action.frame_range]

"""Panache in Blender: restyles the motion of an armature."""

from . import operators, panel, preview, settings

bl_info = {
    'name': 'Panache',
    'description': 'Restyles the motion of an armature: old, angry, proud, or a style of your own',
    'author': 'Panache',
    'version': (0, 2, 0),
    'blender': (3, 4, 0),
    'location': '3D View > Sidebar > Panache',
    'category': 'Animation',
}


def register():
    settings.register()
    operators.register()
    panel.register()
    preview.register()


def unregister():
    preview.unregister()
    panel.unregister()
    operators.unregister()
    settings.unregister()

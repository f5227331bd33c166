"""What a user sets: a slider per style and per part of the shape, and what is remembered of the
last look at the motion."""

import os

import bpy
from bpy.props import (BoolProperty, FloatProperty, PointerProperty, StringProperty)

from . import library, preview

SHIPPED = os.path.join(os.path.dirname(__file__), 'models', 'panache-int8.safetensors')
# name: (label, what it says, default)
SHAPE = {
    'posture': ('Posture', 'Of the lasting part of the style', 1.0),
    'dynamics': ('Movement', 'Of what moves with the motion', 1.0),
    'timing': ('Tempo', "Of the style's own tempo; 0 keeps the frames", 1.0),
    'torso': ('Torso', 'Of what the style does to torso and head', 1.0),
    'legs': ('Legs', 'Of what the style does to legs and root motion', 1.0),
    'left_arm': ('Left Arm', 'Of what the style does to the left arm', 1.0),
    'right_arm': ('Right Arm', 'Of what the style does to the right arm', 1.0),
}
_model = None
_style_class = None


def model():
    """The model in use: the one that was learnt into, else the shipped one."""
    global _model
    path = model_path()
    if _model is None or _model.path != path:
        _model = library.Model(path)
    return _model


def model_path():
    addon = bpy.context.preferences.addons.get(__package__)
    path = bpy.path.abspath(addon.preferences.model) if addon else ''
    return path if path and os.path.exists(path) else SHIPPED


def learnt_path():
    """Where learnt styles are kept."""
    return os.path.join(bpy.utils.user_resource('CONFIG', path='panache', create=True),
                        'styles.safetensors')


def _changed(_, context):
    preview.refresh(context)


def _model_changed(_, context):
    reload_styles()


class PanachePreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    model: StringProperty(name='Model', subtype='FILE_PATH', update=_model_changed,
                          description='Empty: the model that comes with the add-on')

    def draw(self, _):
        self.layout.prop(self, 'model')


def _make_style_class():
    """A slider per style of the model."""
    sliders = {name: FloatProperty(name=name.replace('-', ' ').title(), default=0, min=-4, max=4,
                                   soft_min=0, soft_max=2, step=5, update=_changed,
                                   description='0 is the motion as it is, 1 the style as captured')
               for name in model().styles}
    return type('PanacheStyles', (bpy.types.PropertyGroup,), {'__annotations__': sliders})


def _make_settings_class(styles):
    fields = {name: FloatProperty(name=label, description=text, default=default, min=0, max=2,
                                  update=_changed)
              for name, (label, text, default) in SHAPE.items()}
    fields.update(
        styles=PointerProperty(type=styles),
        preview=BoolProperty(name='Live Preview', update=preview.toggled,
                             description='Show the style at the current frame while sliders move'),
        neutral=PointerProperty(name='Neutral', type=bpy.types.Action),
        styled=PointerProperty(name='Styled', type=bpy.types.Action),
        style_name=StringProperty(name='Name', default='mine'),
        known=StringProperty(), mapping=StringProperty(), notes=StringProperty())
    return type('PanacheSettings', (bpy.types.PropertyGroup,), {'__annotations__': fields})


_classes = []


def _register_sliders():
    styles = _make_style_class()
    bpy.utils.register_class(styles)
    settings = _make_settings_class(styles)
    bpy.utils.register_class(settings)
    bpy.types.Object.panache = PointerProperty(type=settings)
    _classes[:] = [styles, settings]


def _unregister_sliders():
    del bpy.types.Object.panache
    for cls in reversed(_classes):
        bpy.utils.unregister_class(cls)
    _classes.clear()


def reload_styles():
    """After the model was changed."""
    global _model
    _model = None
    preview.stop()
    _unregister_sliders()
    _register_sliders()


def strengths(armature):
    """{style: strength} of the sliders that are not at 0."""
    styles = armature.panache.styles
    return {name: value for name in model().styles
            if (value := getattr(styles, name, 0.0)) != 0}


def shape(armature):
    return {name: getattr(armature.panache, name) for name in SHAPE}


def register():
    bpy.utils.register_class(PanachePreferences)
    _register_sliders()


def unregister():
    _unregister_sliders()
    bpy.utils.unregister_class(PanachePreferences)

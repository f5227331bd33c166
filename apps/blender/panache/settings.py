"""The user's settings: sliders per style for its strength and its side and per part of the shape,
and the results of the last analysis of the motion."""

import hashlib
import os
import tempfile

import bpy
from bpy.props import (BoolProperty, EnumProperty, FloatProperty, PointerProperty, StringProperty)

from . import library, preview

SHIPPED = library.SHIPPED
MANY_STYLES = 20
# name: (label, description, maximum)
SHAPE = {
    'posture': ('Posture', 'Amount of the slow part of the style', 2.0),
    'dynamics': ('Movement', 'Amount of the fast part of the style', 2.0),
    'timing': ('Tempo', "Of the style's own tempo; 0 keeps the frames", 2.0),
    'torso': ('Torso', 'Amount of the style on torso and head', 2.0),
    'legs': ('Legs', 'Amount of the style on legs and root motion', 2.0),
    'left_arm': ('Left Arm', 'Amount of the style on the left arm', 2.0),
    'right_arm': ('Right Arm', 'Amount of the style on the right arm', 2.0),
    'hand_contacts': ('Hand Contacts', 'How firmly hands keep what they touch', 1.0),
    'energy': ('Energy', "From calm (0) to lively (2): the action's own movement of torso, head "
                         'and arms, without a style, too', 2.0),
}
_model = None
_problem = ''  # Why the model in the preferences is not in use.
_path = ''     # Of the model in use without preferences, when started by a script.


def model():
    """The model in use: the one in the preferences, or the shipped one if none is set or it cannot
    be read, which draw_problem() shows."""
    if _model is None:
        _load_model()
    return _model


def _load_model():
    global _model, _problem
    addon = bpy.context.preferences.addons.get(__package__)
    preferences = addon.preferences if addon else None
    path = bpy.path.abspath(preferences.model if preferences else _path)
    folder = bpy.path.abspath(preferences.library) if preferences else ''
    _problem = ''
    if path:
        try:
            _model = library.Model(path, folder)
            _problem = '; '.join(_model.problems)
            return
        except (library.PanacheError, OSError) as error:
            _problem = '%s: %s; the shipped model is in use' % (
                path, error.strerror if isinstance(error, OSError) else error)
    _model = library.Model(SHIPPED, folder)
    _problem = _problem or '; '.join(_model.problems)


def draw_problem(layout):
    model()
    if _problem:
        layout.label(text=_problem, icon='ERROR')


def learnt_path():
    """The path of the model with learnt styles."""
    if __package__.startswith('bl_ext.'):  # Extensions have their own folder.
        folder = bpy.utils.extension_path_user(__package__, create=True)
    else:
        folder = bpy.utils.user_resource('CONFIG', path='panache', create=True)
    return os.path.join(folder, 'styles.safetensors')


def learnt_style(name):
    """The style of this name in the model in use if it was learnt here and may be replaced; None if
    there is no such style. Fails if the style is shipped or from another model, or if learning
    would lose styles learnt before. Names are compared without case."""
    if model().path != learnt_path() and os.path.exists(learnt_path()):
        raise library.PanacheError(
            '%s holds styles that were learnt before, but is not the model in use; expected it as '
            "the model in the add-on's preferences, or moved away" % learnt_path())
    known = {style.casefold(): style for style in model().styles}.get(name.casefold())
    if known is None:
        return None
    shipped = {style.casefold() for style in library.Model(SHIPPED).styles}
    if model().path != learnt_path() or name.casefold() in shipped:
        raise library.PanacheError(
            "style name '%s': the model has a style of that name; choose another" % name)
    return known


def keep_learnt(content):
    """Saves these bytes as the model with learnt styles and makes it the model in use. The file is
    replaced atomically."""
    global _path
    path = learnt_path()
    handle, part = tempfile.mkstemp(prefix='.styles.', suffix='.part', dir=os.path.dirname(path))
    try:
        with os.fdopen(handle, 'wb') as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        os.replace(part, path)
    except BaseException:
        os.unlink(part)
        raise
    addon = bpy.context.preferences.addons.get(__package__)
    if addon is None or addon.preferences is None:
        _path = path
    elif addon.preferences.model != path:
        addon.preferences.model = path  # Reloads.
        return
    reload_styles()


def property_of(style):
    """The name of a style's slider: the style's name, unless Blender does not allow it."""
    if len(style.encode(errors='replace')) <= 63 and not style.startswith('_'):
        return style
    return 'style ' + hashlib.sha1(style.encode(errors='replace')).hexdigest()[:16]


def _changed(found, _):
    preview.refresh(found.id_data)


def _model_changed(_, context):
    reload_styles()


class PanachePreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    model: StringProperty(name='Model', subtype='FILE_PATH', update=_model_changed,
                          description='Empty: the model that comes with the add-on')

    library: StringProperty(name='Library', subtype='DIR_PATH', update=_model_changed,
                            description='A folder of style files, whose styles are shown, too')

    def draw(self, _):
        self.layout.prop(self, 'model')
        self.layout.prop(self, 'library')
        draw_problem(self.layout)


def _make_style_class():
    """A slider per style of the model."""
    sliders = {property_of(name): FloatProperty(
        name=name.replace('-', ' ').title(), default=0, min=-4, max=4, soft_min=0, soft_max=2,
        step=5, update=_changed, description='0 is the input, 1 the style as captured')
        for name in model().styles}
    return type('PanacheStyles', (bpy.types.PropertyGroup,), {'__annotations__': sliders})


def other_side(phrase):
    """What is seen of a mirrored style: 'left leg' for 'right leg'."""
    swapped = {'left': 'right', 'right': 'left'}
    return ' '.join(swapped.get(word, word) for word in phrase.split(' '))


def _make_sides_class():
    """A slider per style for its side."""
    sliders = {}
    for name in model().styles:
        phrase = model().sides[name]
        seen = ': %s, -1: %s' % (phrase, other_side(phrase)) if phrase else ' as captured, -1 mirrored'
        sliders[property_of(name)] = FloatProperty(
            name='Side (1%s)' % seen if phrase else 'Side', default=1, min=-1, max=1, step=10,
            update=_changed, description='1' + seen)
    return type('PanacheSides', (bpy.types.PropertyGroup,), {'__annotations__': sliders})


def title_of(group):
    return group.capitalize() if group else 'Other Styles'


def property_of_group(group):
    """The name of the switch that folds a group, which may be called ''."""
    return property_of('group:' + group)


def _make_groups_class():
    """Whether the sliders of each group are shown. If there are many styles, only the first group
    and learnt styles are shown initially, so that the buttons below stay visible."""
    few = len(model().styles) <= MANY_STYLES
    shown = {property_of_group(group): BoolProperty(name=title_of(group),
                                                    default=few or i == 0 or group == '')
             for i, group in enumerate(model().groups)}
    return type('PanacheGroups', (bpy.types.PropertyGroup,), {'__annotations__': shown})


def _make_settings_class(styles, sides, groups):
    fields = {name: FloatProperty(name=label, description=text, default=1, min=0, max=maximum,
                                  update=_changed)
              for name, (label, text, maximum) in SHAPE.items()}
    fields.update(
        gestures=FloatProperty(
            name='Gestures', default=1, min=0, max=10, soft_max=2, update=_changed,
            description='How often the styles make their gestures: 1 as often as the performers, 0 '
                        'never. An action that loops has none'),
        person=StringProperty(
            name='Person', update=_changed,
            description='Who the armature moves as, in addition to the styles: a number or a word, '
                        'each is another person. Empty: nobody'),
        variety=FloatProperty(
            name='Variety', default=1, min=0, max=2, update=_changed,
            description='How far the person is from the mean of people: 1 as real people differ, 0 '
                        'not at all'),
        timing_where=EnumProperty(
            name='Tempo', default='steps', update=_changed,
            description='Where the style\'s tempo is applied',
            items=[('steps', 'Steps', 'Where the feet step; talk and gestures keep their length'),
                   ('all', 'All', 'Everywhere'), ('off', 'Off', 'Every frame stays in its place')]),
        styles=PointerProperty(type=styles), sides=PointerProperty(type=sides),
        groups=PointerProperty(type=groups),
        preview=BoolProperty(name='Live Preview', update=preview.toggled,
                             description='Show the style at the current frame while sliders move'),
        neutral=PointerProperty(name='Neutral', type=bpy.types.Action,
                                description='The same neutrally, by the same performer; without it '
                                            'the style is learnt against the mean of other people'),
        styled=PointerProperty(name='Styled', type=bpy.types.Action),
        style_name=StringProperty(name='Name', default='mine'),
        known=StringProperty(), mapping=StringProperty(), notes=StringProperty())
    return type('PanacheSettings', (bpy.types.PropertyGroup,), {'__annotations__': fields})


_classes = []


def _register_sliders():
    styles, sides, groups = _make_style_class(), _make_sides_class(), _make_groups_class()
    settings = _make_settings_class(styles, sides, groups)
    for cls in (styles, sides, groups, settings):
        bpy.utils.register_class(cls)
    bpy.types.Object.panache = PointerProperty(type=settings)
    _classes[:] = [styles, sides, groups, settings]


def _unregister_sliders():
    del bpy.types.Object.panache
    for cls in reversed(_classes):
        bpy.utils.unregister_class(cls)
    _classes.clear()


def reload_styles():
    """Call after the model was changed."""
    preview.stop()
    _load_model()
    _unregister_sliders()
    _register_sliders()


def strengths(armature):
    """{style: strength} of the sliders that are not at 0."""
    styles = armature.panache.styles
    return {name: value for name in model().styles
            if (value := getattr(styles, property_of(name), 0.0)) != 0}


def sides(armature):
    """{style: side} of the styles that are put on and whose side is not as captured."""
    return {name: value for name in strengths(armature)
            if (value := getattr(armature.panache.sides, property_of(name), 1.0)) != 1}


def has_side_shown(found, style):
    """Whether the panel draws the slider of a style's side: while the style is put on, if the model
    names its side or the slider was moved."""
    key = property_of(style)
    return getattr(found.styles, key, 0.0) != 0 and (
        model().sides[style] != '' or getattr(found.sides, key, 1.0) != 1)


def sliders_shown(found, styles, is_open):
    """The styles of a group that the panel draws: all, or only those that are not at 0."""
    return [name for name in styles
            if is_open or getattr(found.styles, property_of(name), 0.0) != 0]


def shape(armature):
    return {name: getattr(armature.panache, name) for name in SHAPE}


def person(armature):
    """The person for stylize(), a number or a word; None: nobody, or the model has no persons."""
    text = armature.panache.person.strip()
    return text if text and not model().no_persons else None


def person_problem(armature):
    """Why the person is not put on; '' if it is."""
    return model().no_persons if armature.panache.person.strip() else ''


def describe(armature):
    """What is put on, for the name of an action: 'old 1, person mara, energy 0.5'."""
    parts = ['%s %s' % (name, _amount(value)) for name, value in strengths(armature).items()]
    if person(armature) is not None:
        parts.append('person %s' % person(armature))
    if armature.panache.energy != 1:
        parts.append('energy %s' % _amount(armature.panache.energy))
    return ', '.join(parts) or 'no style'


def _amount(number):
    return ('%.2f' % number).rstrip('0').rstrip('.')


def options(armature):
    """The options of a style besides its strengths, for stylize()."""
    found = armature.panache
    return {'sides': sides(armature), 'shape': shape(armature), 'timing': found.timing_where,
            'gesture_rate': found.gestures, 'person': person(armature), 'variety': found.variety}


def register():
    bpy.utils.register_class(PanachePreferences)
    try:
        _load_model()
        _register_sliders()
    except Exception:  # If the library is missing, nothing stays registered, to allow a retry.
        bpy.utils.unregister_class(PanachePreferences)
        raise


def unregister():
    _unregister_sliders()
    bpy.utils.unregister_class(PanachePreferences)

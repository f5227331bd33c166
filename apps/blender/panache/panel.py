"""The panel in the sidebar of the 3D view."""

import bpy

from . import settings


class _Panel:
    bl_space_type = 'VIEW_3D'
    bl_region_type = 'UI'
    bl_category = 'Panache'

    @classmethod
    def poll(cls, context):
        return context.object is not None and context.object.type == 'ARMATURE'


def _draw_styles(layout, found):
    """A slider per style, by groups that fold; what is not at 0 stays. A model without groups has
    no headings."""
    groups = settings.model().groups
    for group, styles in groups.items():
        column, key = layout.column(align=True), settings.property_of_group(group)
        is_open = list(groups) == [''] or getattr(found.groups, key)
        if list(groups) != ['']:
            column.prop(found.groups, key, emboss=False,
                        icon='TRIA_DOWN' if is_open else 'TRIA_RIGHT')
        for name in settings.sliders_shown(found, styles, is_open):
            column.prop(found.styles, settings.property_of(name), slider=True)
            if settings.has_side_shown(found, name):
                column.prop(found.sides, settings.property_of(name), slider=True)


def _draw_person(layout, armature):
    found, problem = armature.panache, settings.person_problem(armature)
    column = layout.column(align=True)
    column.prop(found, 'person')
    row = column.row()
    row.active = settings.person(armature) is not None
    row.prop(found, 'variety', slider=True)
    if problem:
        layout.label(text=problem, icon='ERROR')


class PANACHE_PT_style(_Panel, bpy.types.Panel):
    bl_label = 'Style'

    def draw(self, context):
        layout, found = self.layout, context.object.panache
        data = context.object.animation_data
        if not data or not data.action:
            layout.label(text='This armature plays no action', icon='INFO')
        settings.draw_problem(layout)
        _draw_styles(layout, found)
        _draw_person(layout, context.object)
        layout.prop(found, 'preview', toggle=True, icon='HIDE_OFF')
        row = layout.row()
        row.scale_y = 1.4
        row.operator('panache.bake', icon='ACTION')


class PANACHE_PT_shape(_Panel, bpy.types.Panel):
    bl_label = 'Shape and Tempo'
    bl_parent_id = 'PANACHE_PT_style'

    def draw(self, context):
        column = self.layout.column(align=True)
        for name in settings.SHAPE:
            column.prop(context.object.panache, name, slider=True)
        column.prop(context.object.panache, 'gestures', slider=True)
        self.layout.row().prop(context.object.panache, 'timing_where', expand=True)


class PANACHE_PT_rig(_Panel, bpy.types.Panel):
    bl_label = 'Rig'
    bl_parent_id = 'PANACHE_PT_style'

    def draw(self, context):
        layout, found = self.layout, context.object.panache
        layout.operator('panache.look', icon='VIEWZOOM')
        if found.known:
            layout.label(text='Familiarity: ' + found.known)
        for note in found.notes.splitlines():
            layout.label(text=note, icon='INFO')
        column = layout.column(align=True)
        for line in found.mapping.splitlines():
            human, _, name = line.partition('\t')
            row = column.split(factor=0.45)
            row.label(text=human)
            row.label(text=name)


class PANACHE_PT_learn(_Panel, bpy.types.Panel):
    bl_label = 'Learn a Style'
    bl_parent_id = 'PANACHE_PT_style'
    bl_options = {'DEFAULT_CLOSED'}

    def draw(self, context):
        layout, found = self.layout, context.object.panache
        layout.prop(found, 'neutral')
        layout.prop(found, 'styled')
        layout.prop(found, 'style_name')
        layout.operator('panache.learn', icon='IMPORT')


_classes = (PANACHE_PT_style, PANACHE_PT_shape, PANACHE_PT_rig, PANACHE_PT_learn)


def register():
    for cls in _classes:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(_classes):
        bpy.utils.unregister_class(cls)

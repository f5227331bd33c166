"""What the buttons do."""

import bpy

from . import baking, controls, library, preview, sampling, settings


def _amount(number):
    return ('%.2f' % number).rstrip('0').rstrip('.')


class _OnArmature:
    bl_options = {'REGISTER', 'UNDO'}

    @classmethod
    def poll(cls, context):
        armature = context.object
        return armature is not None and armature.type == 'ARMATURE'

    def execute(self, context):
        try:
            with preview.paused(context):
                return self.run(context, context.object)
        except library.PanacheError as error:
            self.report({'ERROR'}, str(error))
        except OSError as error:
            self.report({'ERROR'}, '%s: %s' % (error.filename, error.strerror))
        return {'CANCELLED'}

    def source(self, armature):
        action = baking.source_action(armature)
        if action is None:
            raise library.PanacheError('%s plays no action; expected one to restyle' %
                                       armature.name)
        return action


class PANACHE_OT_bake(_OnArmature, bpy.types.Operator):
    """Write the motion in this style as a new action; the old one stays as a muted NLA track"""
    bl_idname = 'panache.bake'
    bl_label = 'Bake'

    def run(self, context, armature):
        action = self.source(armature)
        armature.panache.preview = False
        strengths = settings.strengths(armature)
        sampled = sampling.Sampled(context, armature, action)
        styled = sampled.stylize(settings.model(), strengths, settings.shape(armature),
                                 armature.panache.timing_where)
        preview.note(armature, sampled, styled, controls.Plan(armature, sampled.joints))
        styles = ', '.join('%s %s' % (name, _amount(value)) for name, value in strengths.items())
        new = baking.bake(context, armature, sampled, styled, action,
                          '%s (%s)' % (action.name, styles or 'no style'))
        if context.scene.frame_end < sampled.first + styled.frame_count - 1:
            context.scene.frame_end = sampled.first + styled.frame_count - 1
        context.scene.frame_set(context.scene.frame_current)
        self.report({'INFO'}, "baked '%s'; '%s' is a muted NLA track" % (new.name, action.name))
        return {'FINISHED'}


class PANACHE_OT_look(_OnArmature, bpy.types.Operator):
    """Show which bones were found, and how well the model knows this motion"""
    bl_idname = 'panache.look'
    bl_label = 'Check Rig'

    def run(self, context, armature):
        action = self.source(armature)
        sampled = sampling.Sampled(context, armature, action)
        styled = sampled.stylize(settings.model(), settings.strengths(armature),
                                 settings.shape(armature), armature.panache.timing_where)
        preview.note(armature, sampled, styled, controls.Plan(armature, sampled.joints))
        return {'FINISHED'}


class PANACHE_OT_learn(_OnArmature, bpy.types.Operator):
    """Learn a style from two actions of this armature, one neutral and one in the style"""
    bl_idname = 'panache.learn'
    bl_label = 'Learn'
    bl_options = {'REGISTER'}  # A style is in the model's file, where undo does not reach.

    def run(self, context, armature):
        found = armature.panache
        if not found.neutral or not found.styled:
            raise library.PanacheError('expected two actions, neutral and styled')
        if not armature.animation_data:
            armature.animation_data_create()
        clips = []
        for action in (found.neutral, found.styled):
            sampled = sampling.Sampled(context, armature, action)
            clips.append((sampled, sampled.skeleton.clip(sampled.motion, sampled.frame_seconds)))
        name = found.style_name.strip()
        known = settings.learnt_style(name)
        content, lines = library.learn(settings.model(), [(clips[0][1], clips[1][1])],
                                       known or name, replace=known is not None)
        settings.keep_learnt(content)
        if known:
            lines.insert(0, "'%s' was learnt before and is replaced" % known)
        for line in lines:
            self.report({'INFO'}, line)
        return {'FINISHED'}


_classes = (PANACHE_OT_bake, PANACHE_OT_look, PANACHE_OT_learn)


def register():
    for cls in _classes:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(_classes):
        bpy.utils.unregister_class(cls)

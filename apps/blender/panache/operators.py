"""The operators behind the buttons."""

import contextlib
import time

import bpy

from . import baking, controls, library, preview, sampling, settings


_TICK = 0.01     # Seconds between steps of a bake.
_AT_ONCE = 0.1   # Seconds per step.
_SAMPLING = 0.1  # Share of a bake's progress.


@contextlib.contextmanager
def _reported(operator):
    """Reports an error raised in the block, which it ends."""
    try:
        yield
    except library.PanacheError as error:
        operator.report({'ERROR'}, str(error))
    except OSError as error:
        operator.report({'ERROR'}, '%s: %s' % (error.filename, error.strerror))


def _part(begin, end, work):
    """Maps the progress of `work` to the range `begin` to `end`; returns its result."""
    while True:
        try:
            yield begin + (end - begin) * next(work)
        except StopIteration as stop:
            return stop.value


class _OnArmature:
    bl_options = {'REGISTER', 'UNDO'}

    @classmethod
    def poll(cls, context):
        armature = context.object
        return armature is not None and armature.type == 'ARMATURE'

    def execute(self, context):
        with _reported(self), preview.paused(context):
            return self.run(context, context.object)
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

    # The button shows progress, and Esc cancels; a script call blocks until it is done.
    def invoke(self, context, event):
        if bpy.app.background:
            return self.execute(context)
        self._work = self._guarded(context)
        manager = context.window_manager
        self._timer = manager.event_timer_add(_TICK, window=context.window)
        manager.progress_begin(0, 100)
        manager.modal_handler_add(self)
        return {'RUNNING_MODAL'}

    def modal(self, context, event):
        if event.type == 'ESC':
            self._work.close()
            self.report({'INFO'}, 'cancelled; nothing is changed')
            return self._end(context, {'CANCELLED'})
        if event.type != 'TIMER':
            return {'RUNNING_MODAL'}  # Blocks edits while reading.
        until = time.monotonic() + _AT_ONCE
        try:
            while time.monotonic() < until:
                done = next(self._work)
        except StopIteration as stop:
            return self._end(context, stop.value)
        context.window_manager.progress_update(100 * done)
        context.workspace.status_text_set('Panache: baking, %.0f %%; Esc cancels' % (100 * done))
        return {'RUNNING_MODAL'}

    def _end(self, context, result):
        context.window_manager.event_timer_remove(self._timer)
        context.window_manager.progress_end()
        context.workspace.status_text_set(None)
        return result

    def execute(self, context):
        work = self._guarded(context)
        while True:
            try:
                next(work)
            except StopIteration as stop:
                return stop.value

    # The whole bake as a generator, which yields its progress, 0 to 1.
    def _guarded(self, context):
        with _reported(self), preview.paused(context):
            yield from self._bake(context, context.object)
            return {'FINISHED'}
        return {'CANCELLED'}

    def _bake(self, context, armature):
        action = self.source(armature)
        armature.panache.preview = False
        sampled = yield from _part(0, _SAMPLING, sampling.Sampled.reading(context, armature, action))
        styled = sampled.stylize(settings.model(), settings.strengths(armature),
                                 settings.options(armature))
        preview.note(armature, sampled, styled, controls.Plan(armature, sampled.joints))
        new = yield from _part(_SAMPLING, 1, baking.bake(
            context, armature, sampled, styled, action,
            '%s (%s)' % (action.name, settings.describe(armature))))
        if context.scene.frame_end < sampled.first + len(styled) - 1:
            context.scene.frame_end = sampled.first + len(styled) - 1
        context.scene.frame_set(context.scene.frame_current)
        if settings.person_problem(armature):
            self.report({'WARNING'}, settings.person_problem(armature))
        self.report({'INFO'}, "baked '%s'; '%s' is a muted NLA track" % (new.name, action.name))


class PANACHE_OT_look(_OnArmature, bpy.types.Operator):
    """Show which bones were found, and how well the model knows this motion"""
    bl_idname = 'panache.look'
    bl_label = 'Check Rig'

    def run(self, context, armature):
        action = self.source(armature)
        sampled = sampling.Sampled(context, armature, action)
        styled = sampled.stylize(settings.model(), settings.strengths(armature),
                                 settings.options(armature))
        preview.note(armature, sampled, styled, controls.Plan(armature, sampled.joints))
        return {'FINISHED'}


class PANACHE_OT_learn(_OnArmature, bpy.types.Operator):
    """Learn a style from an action of this armature, best beside a neutral one"""
    bl_idname = 'panache.learn'
    bl_label = 'Learn'
    bl_options = {'REGISTER'}  # Undo does not cover the model file.

    def run(self, context, armature):
        found = armature.panache
        if not found.styled:
            raise library.PanacheError('expected an action in the style')
        if not armature.animation_data:
            armature.animation_data_create()
        clips = [action and sampling.Sampled(context, armature, action).clip
                 for action in (found.neutral, found.styled)]
        name = found.style_name.strip()
        known = settings.learnt_style(name)
        content, lines = library.learn(settings.model(), *clips, known or name,
                                       replace=known is not None)
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

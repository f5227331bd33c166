"""Previews the style at the current frame while sliders move. Changes no animation: without preview
the next frame change shows the action again."""

import contextlib
import json

import bpy

from . import actions, baking, controls, library, sampling

# On a previewed armature: the original values of its unkeyed controls, [[data path, numbers], ...]
# in JSON. Undo steps and saved files contain the styled pose, so they need these too.
SHOWN = 'panache_shown'

# State of the previewed armature. It refers to Blender data, which undo and loading recreate, so
# both drop it.
_state = None
_may_resume = False  # Whether an armature may be in preview without a state.
_busy = False
_rendering = False
_ERRORS = (library.PanacheError, OSError)


class _State:
    def __init__(self, context, armature):
        self.armature = armature
        self.action = baking.source_action(armature)
        if self.action is None:
            raise library.PanacheError('%s plays no action; expected one to restyle' %
                                       armature.name)
        self.sampled = sampling.Sampled(context, armature, self.action)
        self.plan = controls.Plan(armature, self.sampled.joints)
        with sampling.shown_alone(context, armature, self.action):
            self.solver = controls.Solver(context, armature, self.plan, self.action)
        armature[SHOWN] = json.dumps(self.solver.unkeyed)
        self.styled = None

    def stylize(self):
        from . import settings
        self.styled = self.sampled.stylize(settings.model(), settings.strengths(self.armature),
                                           settings.options(self.armature))
        note(self.armature, self.sampled, self.styled, self.plan)

    def show(self, context):
        """Poses the armature, which must be in the unstyled pose of the current frame."""
        frame = min(max(context.scene.frame_current - self.sampled.first, 0),
                    len(self.styled) - 1)
        self.solver.put(self.sampled.world_pose(self.styled, frame))


def note(armature, sampled, styled, plan):
    """Shows in the panel how the rig was mapped and how well the model knows the motion."""
    names = sampled.skeleton.mapping()
    found = armature.panache
    found.mapping = '\n'.join('%s\t%s' % (human, name or '-') for human, name in names.items())
    gate = styled.gates.mean()
    found.known = '%.0f %%' % (100 * gate)
    found.notes = '\n'.join(plan.notes)


@contextlib.contextmanager
def _quiet():
    """Within the block, frame changes show no style."""
    global _busy
    before, _busy = _busy, True
    try:
        yield
    finally:
        _busy = before


def _unstyle(armature):
    """Restores unkeyed properties."""
    if SHOWN in armature:
        actions.put_back(armature, json.loads(armature[SHOWN]))
        del armature[SHOWN]


def _start(context, armature):
    global _state
    stop()
    with _quiet():
        _unstyle(armature)
        state = _State(context, armature)
        state.stylize()
    _state = state


def stop():
    """Ends the preview; keyed poses return with the next frame change."""
    global _state, _may_resume
    if _state is not None:
        try:
            _unstyle(_state.armature)
        except ReferenceError:  # The armature was deleted.
            pass
    _state = None
    _may_resume = True


def _resume(context):
    """Restarts the preview of an armature after its state was dropped."""
    global _may_resume
    _may_resume = False
    for armature in _armatures(bpy.data.objects):
        if armature.panache.preview:
            try:
                _start(context, armature)
            except _ERRORS as error:
                _fail(armature, error)
            return


def _armatures(objects):
    return [o for o in objects if o.type == 'ARMATURE' and o.library is None]


def refresh(armature):
    """Call when a slider of `armature` was moved."""
    context = bpy.context
    if _busy or not armature.panache.preview:
        return
    with _quiet():
        try:
            if (_state is None or _state.armature != armature or
                    baking.source_action(armature) != _state.action):
                _start(context, armature)
            _state.stylize()
            _state.solver.restore()
            context.scene.frame_set(context.scene.frame_current)
            _state.show(context)
        except _ERRORS as error:
            _fail(armature, error)


def toggled(found, context):
    armature = found.id_data
    if not found.preview:
        if _state is None or _state.armature == armature:
            stop()
        _unstyle(armature)
        context.scene.frame_set(context.scene.frame_current)
        return
    for other in _armatures(bpy.data.objects):  # Only one is previewed.
        if other != armature and other.panache.preview:
            other.panache.preview = False
    try:
        _start(context, armature)
    except _ERRORS as error:
        _fail(armature, error)
        return
    _on_frame(context.scene)


def _fail(armature, error):
    armature.panache.preview = False
    armature.panache.notes = str(error)


@contextlib.contextmanager
def paused(context):
    """Within the block, no armature is previewed."""
    was_shown = _state is not None
    stop()
    with _quiet():
        if was_shown:
            context.scene.frame_set(context.scene.frame_current)
        yield
    if was_shown:
        _on_frame(context.scene)


@bpy.app.handlers.persistent
def _on_frame(_scene, _depsgraph=None):
    # Renders change the frame in another thread, on a copy of the data.
    if _busy or _rendering or (_state is None and not _may_resume):
        return
    context = bpy.context
    with _quiet():
        try:
            if _state is None:
                _resume(context)
            if _state is None:
                return
            _state.solver.restore()
            context.view_layer.update()
            _state.show(context)
        except (ReferenceError, KeyError):  # The armature or a bone was deleted.
            stop()


@bpy.app.handlers.persistent
def _after_undo(*_):
    _drop_state()


@bpy.app.handlers.persistent
def _before_load(*_):
    _drop_state()


def _drop_state():
    global _state, _may_resume
    _state, _may_resume = None, True


@bpy.app.handlers.persistent
def _after_load(*_):
    """Shows the action in a file that was saved during a preview."""
    with _quiet():
        for armature in _armatures(bpy.data.objects):
            if armature.panache.preview:
                armature.panache.preview = False
                armature.update_tag(refresh={'TIME'})  # A frame change has no effect yet.


@bpy.app.handlers.persistent
def _before_render(*_):
    """Renders show the action, not the preview."""
    global _rendering
    _rendering = True
    if _state is not None:
        try:
            _state.solver.restore()
        except ReferenceError:
            stop()


@bpy.app.handlers.persistent
def _after_render(*_):
    global _rendering
    _rendering = False


_handlers = {'frame_change_post': _on_frame, 'undo_post': _after_undo, 'redo_post': _after_undo,
             'load_pre': _before_load, 'load_post': _after_load, 'render_init': _before_render,
             'render_complete': _after_render, 'render_cancel': _after_render}


def register():
    for name, handler in _handlers.items():
        getattr(bpy.app.handlers, name).append(handler)


def unregister():
    stop()
    for name, handler in _handlers.items():
        getattr(bpy.app.handlers, name).remove(handler)

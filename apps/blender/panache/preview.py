"""The style at the current frame, while sliders move. Nothing of the file is changed: the next
change of the frame without preview shows the action again."""

import bpy

from . import baking, controls, sampling

_state = None  # Of the armature that is shown styled.
_busy = False


class _State:
    def __init__(self, context, armature):
        self.armature = armature
        self.action = baking.source_action(armature)
        self.sampled = sampling.Sampled(context, armature, self.action)
        self.plan = controls.Plan(armature, self.sampled.joints)
        with sampling.shown_alone(context, armature, self.action):
            self.solver = controls.Solver(context, armature, self.plan, self.action)
        self.styled = None

    def stylize(self):
        from . import settings
        self.styled = self.sampled.stylize(settings.model(), settings.strengths(self.armature),
                                           settings.shape(self.armature))
        note(self.armature, self.sampled, self.styled, self.plan)

    def show(self, context):
        frame = min(max(context.scene.frame_current - self.sampled.first, 0),
                    self.styled.frame_count - 1)
        self.solver.put(self.sampled.world_pose(self.styled, frame))


def note(armature, sampled, styled, plan):
    """Puts into the panel how the rig was understood and how well the motion is known."""
    names = sampled.skeleton.mapping()
    found = armature.panache
    found.mapping = '\n'.join('%s\t%s' % (human, name or '-') for human, name in names.items())
    gate = sum(styled.gates) / len(styled.gates)
    found.known = '%.0f %%' % (100 * gate)
    found.notes = '\n'.join(plan.notes)


def refresh(context):
    """A slider was moved."""
    global _busy
    if _state is None or _busy or context.object != _state.armature:
        return
    _busy = True
    try:
        if baking.source_action(_state.armature) != _state.action:
            start(context, _state.armature)
        _state.stylize()
        _state.solver.restore()
        context.scene.frame_set(context.scene.frame_current)
        _state.show(context)
    finally:
        _busy = False


def toggled(found, context):
    armature = context.object
    if not found.preview:
        stop()
        context.scene.frame_set(context.scene.frame_current)
        return
    try:
        start(context, armature)
    except Exception as error:
        stop()
        found['preview'] = False
        found.notes = str(error)
        return
    _on_frame(context.scene)


def start(context, armature):
    global _state
    if armature is None or baking.source_action(armature) is None:
        raise ValueError('the armature plays no action; expected one to restyle')
    _state = _State(context, armature)
    _state.stylize()
    if _on_frame not in bpy.app.handlers.frame_change_post:
        bpy.app.handlers.frame_change_post.append(_on_frame)


def stop():
    global _state
    if _state is not None:
        try:
            _state.solver.restore()
        except ReferenceError:
            pass
    _state = None
    if _on_frame in bpy.app.handlers.frame_change_post:
        bpy.app.handlers.frame_change_post.remove(_on_frame)


@bpy.app.handlers.persistent
def _on_frame(_scene, _depsgraph=None):
    global _busy
    if _state is None or _busy:
        return
    _busy = True
    try:
        _state.solver.restore()
        bpy.context.view_layer.update()
        _state.show(bpy.context)
    except ReferenceError:  # The armature is gone.
        stop()
    finally:
        _busy = False

"""Finds the bones that control an armature's pose, and moves them so that its joints reach a given
pose: directly, or through IK targets, poles and Rigify's controls."""

import math

from mathutils import Matrix, Quaternion

from . import actions, sampling

# Rigify: control, and the bone (without ORG-) that follows it. Parents first. A limb is moved by
# its IK or its FK controls, depending on its switch.
_RIGIFY_SPINE = [('chest', 'spine.003'), ('neck', 'spine.004'), ('head', 'spine.006')]
_RIGIFY_LIMBS = [
    # parent with the switch, FK, (IK control, its follower), pole, IK root, joints
    ('upper_arm_parent', ['upper_arm_fk', 'forearm_fk', 'hand_fk'], 'hand_ik',
     'upper_arm_ik_target', 'upper_arm_ik', ['upper_arm', 'forearm', 'hand']),
    ('thigh_parent', ['thigh_fk', 'shin_fk', 'foot_fk'], 'foot_ik', 'thigh_ik_target', 'thigh_ik',
     ['thigh', 'shin', 'foot'])]
_MOST_ROUNDS = 8  # Max iterations for a control.
_NEAR = 2e-4      # Converged, radians and metres.
_STALLED = 0.8    # Max ratio to the previous error.


class Follow:
    """A control that a joint follows rigidly."""

    def __init__(self, control, joint):
        self.control, self.joint = control, joint


class Lead:
    """A control that a joint follows indirectly: it is rotated, and moved if `moves` is set, until
    the joint reaches its goal."""

    def __init__(self, control, joint, moves):
        self.control, self.joint, self.moves = control, joint, moves


class Knee:
    """A control that rotates the plane of a limb about the line from its root to its end."""

    def __init__(self, control, upper, lower, end):
        self.control, self.joints = control, (upper, lower, end)


class Pole:
    """A control that a knee or elbow points at."""

    def __init__(self, control, upper, lower, end):
        self.control, self.joints = control, (upper, lower, end)


class Plan:
    """Which bones to move, and how, to pose an armature."""

    def __init__(self, armature, joints):
        self.joints = joints
        self.index = {joint.bone: i for i, joint in enumerate(joints) if joint.bone}
        self.direct = []  # Bones that are set directly, parents first.
        self.moves = []   # Follow, Lead, Knee or Pole, in order of evaluation.
        self.notes = []
        if sampling.is_rigify(armature):
            self._plan_rigify(armature.pose.bones)
        else:
            self._plan_bones(armature)

    def controls(self):
        names = list(self.direct)
        return names + [m.control for m in self.moves if m.control not in names]

    # Rigs with constraints: a constrained bone is moved through the target.
    def _plan_bones(self, armature):
        bones = armature.pose.bones
        driven, targets, poles = set(), {}, {}
        for bone in bones:
            for constraint in bone.constraints:
                if constraint.mute or not constraint.influence:
                    continue
                if constraint.type == 'IK':
                    chain = [bone] + list(bone.parent_recursive)
                    chain = chain[:constraint.chain_count or len(chain)]
                    driven.update(b.name for b in chain)
                    self._add_target(armature, constraint, self._end_of(bone), targets)
                    if constraint.pole_target == armature and len(chain) > 1:
                        poles[constraint.pole_subtarget] = Pole(
                            constraint.pole_subtarget, chain[1].name, bone.name,
                            self._end_of(bone))
                elif constraint.type in ('COPY_ROTATION', 'COPY_TRANSFORMS', 'COPY_LOCATION'):
                    driven.add(bone.name)
                    self._add_target(armature, constraint, bone.name, targets)
                elif constraint.type not in ('LIMIT_ROTATION', 'LIMIT_LOCATION', 'LIMIT_SCALE'):
                    self.notes.append('%s has a constraint %s, which is ignored' % (
                        bone.name, constraint.type.replace('_', ' ').lower()))
        carried = set(targets) | set(poles)
        self.direct = [b.name for b in bones if b.name not in driven and b.name not in carried]
        order = {bone.name: i for i, bone in enumerate(bones)}
        for name in sorted(targets, key=order.get):
            self.moves.append(Follow(name, targets[name]))
        self.moves += [poles[name] for name in sorted(poles, key=order.get)]

    # The bone at the tip of a chain, a foot or hand, whose pose the IK target sets.
    def _end_of(self, bone):
        for child in bone.children:
            if (child.bone.head_local - bone.bone.tail_local).length < 1e-3 * bone.bone.length:
                return child.name
        return bone.name

    def _add_target(self, armature, constraint, joint, targets):
        if constraint.target == armature and constraint.subtarget:
            # A foot that rotates with its target determines it better than the shin's end.
            targets.setdefault(constraint.subtarget, joint)
        elif constraint.target:
            self.notes.append('%s is moved by %s, which is no bone of the armature and is left '
                              'alone' % (joint, constraint.target.name))

    def _plan_rigify(self, bones):
        def add(control, joint, kind=Follow, *rest):
            if control in bones and 'ORG-' + joint in self.index:
                self.moves.append(kind(control, 'ORG-' + joint, *rest))
        add('torso', 'spine')
        for control, joint in _RIGIFY_SPINE:
            add(control, joint, Lead, control == 'chest')
        for side in ('.L', '.R'):
            add('shoulder' + side, 'shoulder' + side)
            for parent, fk, ik, pole, root, joints in _RIGIFY_LIMBS:
                switch = bones.get(parent + side)
                if switch is None:
                    continue
                if switch.get('IK_FK', 0.0) > 0.5:
                    for control, joint in zip(fk, joints):
                        add(control + side, joint + side)
                else:
                    add(ik + side, joints[2] + side)
                    limb = ['ORG-' + joint + side for joint in joints]
                    if switch.get('pole_vector', 0):
                        self.moves.append(Pole(pole + side, *limb))
                    else:
                        self.moves.append(Knee(root + side, *limb))
            for toe in ('toe_ik', 'toe_fk', 'toe'):
                if toe + side in bones:
                    add(toe + side, 'toe' + side)
                    break


def _rigid(pose):
    turn, position = pose
    return Matrix.Translation(position) @ turn.to_matrix().to_4x4()


class Solver:
    """Poses an armature by setting its pose bones, one pose at a time."""

    def __init__(self, context, armature, plan, action):
        self.context, self.armature, self.plan = context, armature, plan
        # Unkeyed properties would keep their new values after a frame change, so they are stored:
        # [[data path, numbers], ...], without references to bones, which editing recreates.
        keyed = {curve.data_path for curve in actions.curves(armature, action)}
        targets = [(None, armature)] + [(name, armature.pose.bones[name])
                                        for name in plan.controls()]
        self.unkeyed = [[actions.data_path(bone, name), list(getattr(target, name))]
                        for bone, target in targets
                        for name in ('location', rotation_property(target))
                        if actions.data_path(bone, name) not in keyed]

    def restore(self):
        """Restores unkeyed properties; call before setting the next frame."""
        actions.put_back(self.armature, self.unkeyed)

    def put(self, wanted):
        """wanted: [joints] (rotation, position), world space. The armature must be in the unstyled
        pose of that time."""
        to_armature = self.armature.matrix_world.inverted()
        self._put_object(wanted)
        current = self._current()
        goal = [self._goal(to_armature, now, pose) for now, pose in zip(current, wanted)]
        # The offsets of controls from joints are measured in the unstyled pose: in the styled one
        # they would be wrong where IK cannot reach.
        before = {move.control: self._bones()[move.control].matrix.copy()
                  for move in self.plan.moves}
        self._put_direct(goal)
        # Parents first, so that no control moves a joint that is already in place.
        for move in self.plan.moves:
            if isinstance(move, Lead):
                self._approach(lambda: self._lead(move, goal))
            elif isinstance(move, Knee):
                self._approach(lambda: self._turn_knee(move, goal))
            else:
                self.context.view_layer.update()
                self._set(move, before[move.control], current, goal)

    def _approach(self, turn):
        """Calls turn() until the remaining error is small or stops shrinking: a control of several
        joints may not bring all of them to their goals."""
        left = math.inf
        for _ in range(_MOST_ROUNDS):
            self.context.view_layer.update()
            before, left = left, turn()
            if left < _NEAR or left > _STALLED * before:
                return

    def _bones(self):
        return self.armature.pose.bones

    # [joints] matrices in armature space, None for the object.
    def _current(self):
        evaluated = self.armature.evaluated_get(self.context.evaluated_depsgraph_get())
        bones = evaluated.pose.bones
        return [bones[j.bone].matrix.copy() if j.bone else None for j in self.plan.joints]

    # The goal in armature space, with the bone's current scale.
    def _goal(self, to_armature, now, pose):
        if now is None:
            return None
        moved = to_armature @ _rigid(pose)
        position, turn, _ = moved.decompose()
        return Matrix.LocRotScale(position, turn, now.to_scale())

    def _put_object(self, wanted):
        turn, position = wanted[0]
        now, now_turn, scale = self.armature.matrix_world.decompose()
        if (position - now).length < 1e-6 and turn.rotation_difference(now_turn).angle < 1e-6:
            return
        self.armature.matrix_world = Matrix.LocRotScale(position, turn, scale)

    def _put_direct(self, goal):
        for name in self.plan.direct:
            bone = self._bones()[name]
            at = self.plan.index[name]
            if bone.parent:
                above = goal[self.plan.index[bone.parent.name]]
                basis = bone.bone.convert_local_to_pose(
                    goal[at], bone.bone.matrix_local, parent_matrix=above,
                    parent_matrix_local=bone.parent.bone.matrix_local, invert=True)
            else:
                basis = bone.bone.convert_local_to_pose(goal[at], bone.bone.matrix_local,
                                                        invert=True)
            _set_basis(bone, basis)

    def _set(self, move, before, current, goal):
        if isinstance(move, Pole):
            after = self._pole_position(move, before, current, goal)
        else:
            at = self.plan.index[move.joint]
            after = goal[at] @ current[at].inverted() @ before
        _set_matrix(self._bones()[move.control], after)

    # These two return the error before the move, radians and metres.
    def _lead(self, move, goal):
        bone = self._bones()[move.control]
        at = self.plan.index[move.joint]
        now = self._current()[at]
        turn = goal[at].to_quaternion() @ now.to_quaternion().inverted()
        shift = goal[at].translation - now.translation
        position, old, scale = bone.matrix.decompose()
        if move.moves:
            # It rotates the joint about another point, so half a step is safer.
            position = position + 0.7 * shift
        _set_matrix(bone, Matrix.LocRotScale(position, turn @ old, scale), stays=not move.moves)
        return max(abs(_signed(turn.angle)), shift.length if move.moves else 0)

    def _turn_knee(self, move, goal):
        bone = self._bones()[move.control]
        indices = [self.plan.index[name] for name in move.joints]
        now = self._current()
        old = _bend_frame(*[now[i].translation for i in indices])
        new = _bend_frame(*[goal[i].translation for i in indices])
        if old is None or new is None:
            return 0
        along, bend = new.col[0].to_3d(), new.col[1].to_3d()
        before = old.col[1].to_3d()
        before = (before - along * before.dot(along)).normalized()
        angle = math.atan2(before.cross(bend).dot(along), before.dot(bend))
        position, turn, scale = bone.matrix.decompose()
        turn = Quaternion(along, angle) @ turn
        _set_matrix(bone, Matrix.LocRotScale(position, turn, scale), stays=True)
        return abs(angle)

    # The pole keeps its position relative to the plane of hip, knee and ankle.
    def _pole_position(self, move, before, current, goal):
        indices = [self.plan.index[name] for name in move.joints]
        old = _bend_frame(*[current[i].translation for i in indices])
        new = _bend_frame(*[goal[i].translation for i in indices])
        if old is None or new is None:
            # A straight limb has no direction: the pole follows its upper part.
            old, new = current[indices[0]], goal[indices[0]]
        return Matrix.Translation(new @ old.inverted() @ before.translation -
                                  before.translation) @ before


def _bend_frame(root, middle, end):
    along = (end - root).normalized()
    bend = (middle - root) - along * (middle - root).dot(along)
    if bend.length < 0.01 * (middle - root).length:
        return None
    bend.normalize()
    frame = Matrix((along, bend, along.cross(bend))).transposed().to_4x4()
    frame.translation = root
    return frame


def _set_basis(bone, basis):
    """Sets rotation and location; styles never change scale."""
    position, turn, _ = basis.decompose()
    bone.location = position
    set_rotation(bone, turn)


def _signed(angle):
    return angle if angle < math.pi else angle - 2 * math.pi


def _set_matrix(bone, matrix, stays=False):
    """Sets the bone to `matrix` without changing its scale; only rotates it if it `stays`."""
    position, scale = tuple(bone.location), tuple(bone.scale)
    bone.matrix = matrix
    bone.scale = scale
    if stays:
        bone.location = position


def rotation_property(target):
    return {'QUATERNION': 'rotation_quaternion', 'AXIS_ANGLE': 'rotation_axis_angle'}.get(
        target.rotation_mode, 'rotation_euler')


def set_rotation(bone, turn):
    if bone.rotation_mode == 'QUATERNION':
        bone.rotation_quaternion = turn
    elif bone.rotation_mode == 'AXIS_ANGLE':
        axis, angle = turn.to_axis_angle()
        bone.rotation_axis_angle = (angle, *axis)
    else:
        bone.rotation_euler = turn.to_euler(bone.rotation_mode, bone.rotation_euler)



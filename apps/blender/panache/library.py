"""The parts of Panache's Python package that the add-on uses. An extension has it as a wheel; the
add-on for older versions of Blender is itself named panache, and has it inside, as `core`."""

import glob
import importlib
import os

package = importlib.import_module('panache' if __package__.startswith('bl_ext.') else '.core',
                                  __package__)
Clip, PanacheError, Skeleton = package.Clip, package.PanacheError, package.Skeleton
stylize = package.stylize

__all__ = ['Clip', 'Model', 'PanacheError', 'SHIPPED', 'Skeleton', 'learn', 'stylize']

SHIPPED = os.path.join(os.path.dirname(package.__file__), 'models', 'panache-int8.safetensors')


class Model:
    """A model file, plus the styles of a folder of style files.

    `own` is the file's model, to which learnt styles are added; `all` includes the folder's."""

    def __init__(self, path, folder=''):
        self.path = path
        self.own = self.all = package.Model(path)
        self.problems = []  # Errors of unusable style files.
        files = glob.glob(os.path.join(glob.escape(folder), '*.safetensors')) if folder else []
        for name in sorted(files):
            try:
                with open(name, 'rb') as file:
                    self.all = self.all.add(file.read(), replace=True)
            except (PanacheError, OSError) as error:
                self.problems.append('%s: %s' % (name, error))
        self.styles = self.all.styles
        self.sides = dict(zip(self.styles, self.all.sides))  # 'right leg', or ''.
        # The error of every person, if the model has none; else ''.
        self.no_persons = ''
        try:
            self.all.person(0)
        except PanacheError as error:
            self.no_persons = str(error)
        # {group: its styles}, in the model's order; '' holds styles without a group.
        self.groups = {}
        for style, group in zip(self.styles, self.all.groups):
            self.groups.setdefault(group, []).append(style)


def learn(model, neutral, styled, name, replace):
    """Learns a style from clips of one rig; if `neutral` is None, the mean of other people is used.
    An existing style of that name is replaced if `replace`, else it is an error. Returns the bytes
    of the model with the style, and messages about it."""
    learnt = package.learn(model.own, [(neutral, styled)] if neutral else styled, name, replace)
    lines = list(learnt.warnings)
    if learnt.people:
        lines.insert(0, 'without a neutral action: %d other people move alike; %.0f %% of the '
                     'difference in posture counts as style' % (learnt.people, 100 * learnt.certainty))
    if learnt.verdict:
        lines.insert(0, 'learnt %s (%s): %.1f cm off on the held-back part, %.1f without it' % (
            name, learnt.verdict, learnt.held_back_cm, learnt.untouched_cm))
    return learnt.model.content, lines

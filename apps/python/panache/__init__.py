"""Panache stylizes the motion of characters: neutral motion in, the same motion in an old, angry or
proud style out.

    import panache

    model = panache.Model()                       # the shipped one
    walk = panache.read('walk.bvh')               # a Clip: arrays and a skeleton
    old = panache.stylize(model, walk, {'old': 1})
    panache.stylize_file('walk.bvh', 'old.bvh', {'old': 1})

Rotations are unit quaternions (x, y, z, w) and translations are vectors, both of a joint relative
to its parent, in the skeleton's own units and axes. Arrays are contiguous float32 numpy arrays;
others are converted, which copies them. Errors raise `PanacheError` with the library's message.
"""

from ._library import PanacheError, version
from .character import Character, Crowd, Report
from .clips import Clip, Skeleton, StyledClip, retarget, stylize
from .files import MotionFile, info, read, retarget_file, stylize_file
from .learning import Learnt, Samples, learn, training_samples
from .model import Model, shipped_models

__version__ = version()
__all__ = ['Character', 'Clip', 'Crowd', 'Learnt', 'Model', 'MotionFile', 'PanacheError', 'Report',
           'Samples', 'Skeleton', 'StyledClip', 'info', 'learn', 'read', 'retarget',
           'retarget_file', 'shipped_models', 'stylize', 'stylize_file', 'training_samples']

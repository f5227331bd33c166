"""What the add-on does with actions, against stand-ins written from Blender's documented interface:
channels of the action itself up to 4.3, of a slot from 4.4 on, and no Action.fcurves in 5.0.
Needs no Blender."""

import os
import sys
import types
import unittest

sys.dont_write_bytecode = True
ADDON = os.path.join(os.path.dirname(__file__), '../../apps/blender/panache')


class Curve:
    def __init__(self, path, index):
        self.data_path, self.array_index, self.group, self.keys = path, index, None, []

    def range(self):
        return min(self.keys), max(self.keys)


class Curves(list):
    def new(self, data_path, *, index=0):
        assert self.find(data_path, index=index) is None, 'Blender raises'
        self.append(Curve(data_path, index))
        return self[-1]

    def find(self, data_path, *, index=0):
        return next((c for c in self if (c.data_path, c.array_index) == (data_path, index)), None)


class Groups(dict):
    def new(self, name):
        self[name] = 'group ' + name
        return self[name]


class Channels:
    def __init__(self):
        self.fcurves, self.groups = Curves(), Groups()


class Named:
    def __init__(self, **fields):
        self.__dict__.update(fields)


class Strip:
    type = 'KEYFRAME'

    def __init__(self):
        self.bags = {}

    def channelbag(self, slot, *, ensure=False):
        assert slot is not None, 'Blender raises'
        if ensure:
            self.bags.setdefault(slot.identifier, Channels())
        return self.bags.get(slot.identifier)


class Strips(list):
    def new(self, *, type):
        assert type == 'KEYFRAME'
        self.append(Strip())
        return self[-1]


class Layers(list):
    def new(self, name):
        self.append(Named(name=name, strips=Strips()))
        return self[-1]


PREFIXES = {'OBJECT': 'OB', 'KEY': 'KE', 'UNSPECIFIED': 'XX'}


class Slots(list):
    def new(self, id_type, name):
        self.append(Named(target_id_type=id_type, identifier=PREFIXES[id_type] + name))
        return self[-1]


class SlottedAction:
    """From 5.0 on. It has no fcurves and no groups."""

    def __init__(self, name='walk', *slots, frame_range=(1, 10)):
        self.name, self.slots, self.layers = name, Slots(), Layers()
        self.frame_range, self.use_frame_range = frame_range, False
        for slot in slots:
            self.slots.new(*slot)

    def bag(self, slot):
        strips = (self.layers or [self.layers.new('Layer')])[0].strips
        return (strips or [strips.new(type='KEYFRAME')])[0].channelbag(slot, ensure=True)


class SlottedData:
    """Assigning an action may leave the slot empty, where Blender finds none that fits."""

    def __init__(self):
        self._action, self.action_slot, self.last_slot_identifier = None, None, ''

    @property
    def action(self):
        return self._action

    @action.setter
    def action(self, action):
        self._action, self.action_slot = action, None

    def __setattr__(self, name, value):
        if name == 'action_slot' and value is not None:
            assert value in self.action.slots, 'Blender raises'
            self.last_slot_identifier = value.identifier
        object.__setattr__(self, name, value)


class OldAction(Channels):
    """Up to 4.3."""

    def __init__(self, frame_range=(1, 10)):
        super().__init__()
        self.frame_range = frame_range


bpy = types.ModuleType('bpy')
bpy.app = Named(version=(3, 4, 1))
bpy.utils = Named(escape_identifier=lambda name: name.replace('"', '\\"'))
sys.modules['bpy'] = bpy
package = types.ModuleType('panache')
package.__path__ = [ADDON]
sys.modules['panache'] = package
core = types.ModuleType('panache.core')
core.Clip = core.Model = core.Skeleton = core.learn = core.stylize = None
core.__file__ = os.path.join(ADDON, 'core', '__init__.py')
core.PanacheError = type('PanacheError', (Exception,), {})
sys.modules['panache.core'] = core
from panache import actions, library  # noqa: E402


class Old(unittest.TestCase):
    def setUp(self):
        bpy.app.version = (4, 3, 2)
        self.rig = Named(name='Rig', animation_data=Named(action=None))

    def test_channels_are_those_of_the_action(self):
        action = OldAction()
        curve = actions.replace_curve(self.rig, action, 'location', 2, 'Root')
        self.assertEqual(curve.group, 'group Root')
        again = actions.replace_curve(self.rig, action, 'location', 2, 'Root')
        self.assertIsNot(curve, again)
        self.assertEqual(actions.curves(self.rig, action), [again])
        self.assertEqual(actions.frame_range(self.rig, action), (1, 10))

    def test_slots_of_4_3_are_an_experiment_and_not_used(self):
        action = OldAction()
        action.slots = Slots()
        self.assertIsNone(actions.slot_of(self.rig, action))

    def test_playing_and_playing_again(self):
        action = OldAction()
        before = actions.playing(self.rig)
        actions.play(self.rig, action)
        self.assertIs(self.rig.animation_data.action, action)
        actions.play_slot(self.rig, *before)
        self.assertIsNone(self.rig.animation_data.action)

    def test_a_strip_has_no_slot(self):
        track = Named(strips=Named(new=lambda name, start, action: Named(action=action)))
        strip = actions.add_strip(track, 'walk', 1, self.rig, OldAction())
        self.assertFalse(hasattr(strip, 'action_slot'))


class Slotted(unittest.TestCase):
    def setUp(self):
        bpy.app.version = (5, 0, 0)
        self.rig = Named(name='Rig', animation_data=SlottedData())

    def test_the_slot_in_use_is_taken(self):
        action = SlottedAction('walk', ('OBJECT', 'Other'), ('OBJECT', 'Rig'))
        self.rig.animation_data.action = action
        self.rig.animation_data.action_slot = action.slots[0]
        self.assertIs(actions.slot_of(self.rig, action), action.slots[0])

    def test_of_an_action_that_is_not_played_the_slot_of_the_same_identifier_is_taken(self):
        walk = SlottedAction('walk', ('OBJECT', 'Hero'))
        run = SlottedAction('run', ('OBJECT', 'Rig'), ('OBJECT', 'Hero'))
        self.rig.animation_data.action = walk
        self.rig.animation_data.action_slot = walk.slots[0]
        self.assertEqual(actions.slot_of(self.rig, run).identifier, 'OBHero')
        self.rig.animation_data.action = None  # Blender remembers the last one.
        self.assertEqual(actions.slot_of(self.rig, run).identifier, 'OBHero')

    def test_else_that_of_the_objects_name_and_else_the_first_for_objects(self):
        action = SlottedAction('walk', ('KEY', 'Rig'), ('OBJECT', 'Other'), ('OBJECT', 'Rig'))
        self.assertEqual(actions.slot_of(self.rig, action).identifier, 'OBRig')
        action.slots.pop()
        self.assertEqual(actions.slot_of(self.rig, action).identifier, 'OBOther')
        self.rig.animation_data = None
        self.assertEqual(actions.slot_of(self.rig, action).identifier, 'OBOther')

    def test_an_action_of_something_else_is_rejected(self):
        action = SlottedAction('smile', ('KEY', 'Face'))
        with self.assertRaisesRegex(library.PanacheError, "^smile has no slot for an object, only "
                                                          "for 'KEFace'; expected an action of an"):
            actions.slot_of(self.rig, action)

    def test_only_the_channels_of_the_slot_are_seen_and_changed(self):
        action = SlottedAction('walk', ('OBJECT', 'Other'), ('OBJECT', 'Rig'))
        other = action.bag(action.slots[0]).fcurves.new('location', index=0)
        other.keys = [1, 100]
        own = action.bag(action.slots[1]).fcurves.new('location', index=0)
        own.keys = [3, 20]
        self.assertEqual(actions.curves(self.rig, action), [own])
        self.assertEqual(actions.frame_range(self.rig, action), (3, 20))
        new = actions.replace_curve(self.rig, action, 'location', 0, 'Root')
        self.assertEqual(actions.curves(self.rig, action), [new])
        self.assertEqual(new.group, 'group Root')
        self.assertEqual(action.bag(action.slots[0]).fcurves, [other])

    def test_a_range_that_was_set_by_hand_counts(self):
        action = SlottedAction('walk', ('OBJECT', 'Other'), ('OBJECT', 'Rig'), frame_range=(5, 9))
        action.bag(action.slots[1]).fcurves.new('location', index=0).keys = [3, 20]
        action.use_frame_range = True
        self.assertEqual(actions.frame_range(self.rig, action), (5, 9))

    def test_channels_are_made_where_there_are_none(self):
        action = SlottedAction()
        self.assertEqual(actions.curves(self.rig, action), [])
        actions.replace_curve(self.rig, action, 'location', 1, 'Root')
        self.assertEqual([s.identifier for s in action.slots], ['OBRig'])
        self.assertEqual([c.array_index for c in actions.curves(self.rig, action)], [1])
        without_channels = SlottedAction('idle', ('OBJECT', 'Rig'))
        without_channels.layers.new('Layer')
        self.assertEqual(actions.curves(self.rig, without_channels), [])
        actions.replace_curve(self.rig, without_channels, 'location', 1, 'Root')
        self.assertEqual(len(actions.curves(self.rig, without_channels)), 1)

    def test_the_slot_is_played_with_the_action_and_put_back(self):
        walk, run = (SlottedAction(name, ('OBJECT', 'Other')) for name in ('walk', 'run'))
        actions.play(self.rig, walk)
        self.assertIs(self.rig.animation_data.action_slot, walk.slots[0])
        before = actions.playing(self.rig)
        actions.play(self.rig, run)
        self.assertIs(self.rig.animation_data.action_slot, run.slots[0])
        actions.play_slot(self.rig, *before)
        self.assertEqual(actions.playing(self.rig), (walk, walk.slots[0]))
        actions.play_slot(self.rig, None, None)
        self.assertEqual(actions.playing(self.rig), (None, None))

    def test_a_strip_gets_the_slot(self):
        track = Named(strips=Named(new=lambda name, start, action: Named(action=action)))
        action = SlottedAction('walk', ('OBJECT', 'Other'), ('OBJECT', 'Rig'))
        strip = actions.add_strip(track, 'walk', 1, self.rig, action)
        self.assertIs(strip.action_slot, action.slots[1])


class Slotted44(Slotted):
    """4.4 and 4.5, where Action.fcurves is still there and shows the channels of the first slot."""

    def setUp(self):
        super().setUp()
        bpy.app.version = (4, 4, 0)
        SlottedAction.fcurves = property(lambda self: self.bag(self.slots[0]).fcurves)
        self.addCleanup(lambda: delattr(SlottedAction, 'fcurves'))


class Sources(unittest.TestCase):
    def test_no_other_module_reads_channels_or_changes_what_is_played(self):
        for name in os.listdir(ADDON):
            if not name.endswith('.py') or name == 'actions.py':
                continue
            with open(os.path.join(ADDON, name)) as file:
                text = file.read()
            for word in ('fcurves', 'action.groups', '.groups.new', 'data.action =', 'strips.new',
                         'frame_range'):
                self.assertFalse(word in text.replace('actions.frame_range', ''), (name, word))


if __name__ == '__main__':
    unittest.main()

"""The structs that the add-on hands to the library are those of panache.h: names, sizes and places
of their fields, as the compiler sees them. structs_test.py STRUCT_SIZES"""

import ctypes
import importlib.util
import os
import subprocess
import sys

sys.dont_write_bytecode = True
path = os.path.join(os.path.dirname(__file__), '..', '..', 'apps', 'blender', 'panache',
                    'library.py')
spec = importlib.util.spec_from_file_location('library', path)
library = importlib.util.module_from_spec(spec)
spec.loader.exec_module(library)

names = {'strength_key': '_Key', 'strength_track': '_Track'}
lines = subprocess.run([sys.argv[1]], check=True, capture_output=True, text=True).stdout.split('\n')
seen = set()
for line in filter(None, lines):
    name, size, *fields = line.split()
    struct = getattr(library, names.get(name, '_' + name.title().replace('_', '')), None)
    if struct is None:  # The add-on does not use it.
        continue
    assert ctypes.sizeof(struct) == int(size), name
    assert [text for field, _ in struct._fields_
            for text in (field, str(getattr(struct, field).offset))] == fields, name
    seen.add(struct)
own = {value for value in vars(library).values()
       if isinstance(value, type) and issubclass(value, ctypes.Structure)}
assert seen == own - {ctypes.Structure}, own - seen

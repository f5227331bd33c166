"""The structs, constants and functions of the C interface, as panache.h declares them."""

import ctypes
import pathlib
import re
from types import SimpleNamespace

_HEADER = pathlib.Path(__file__).with_name('panache.h')
_TEXT = re.sub(r'/\*.*?\*/', '', _HEADER.read_text(encoding='utf-8'), flags=re.DOTALL)
_NUMBERS = {'void': None, 'float': ctypes.c_float, 'double': ctypes.c_double,
            'int32_t': ctypes.c_int32, 'uint32_t': ctypes.c_uint32, 'size_t': ctypes.c_size_t}


def _constant(name: str) -> int:
    return int(re.search(rf'#define PANACHE_{name} (\d+)', _TEXT)[1])


VERSION = _constant('VERSION_MAJOR'), _constant('VERSION_MINOR')
WINDOW_SIZE, CHANGE_SIZE = _constant('WINDOW_SIZE'), _constant('CHANGE_SIZE')
# 'other', 'file_exists', ...: in the order of panache_error_kind.
ERROR_KINDS = tuple(name.lower() for name in re.findall(r'PANACHE_ERROR_(\w+) = \d+', _TEXT))
_ENUMS = set(re.findall(r'} (panache_\w+);', ''.join(re.findall(r'typedef enum.*?;', _TEXT, re.S))))

structs = SimpleNamespace()  # panache_clip_edit is structs.ClipEdit.


def _class_name(name: str) -> str:
    return name[len('panache_'):].title().replace('_', '')


def _kind(text: str):
    """The ctypes type at the start of a declaration: a number, a struct or a pointer to a struct;
    other pointers are plain addresses."""
    name, stars = text.replace('const', ' ').replace('*', ' ').split()[0], text.count('*')
    struct = getattr(structs, _class_name(name), None)
    if not stars:
        return struct or (ctypes.c_int32 if name in _ENUMS else _NUMBERS[name])
    if stars == 2:
        return ctypes.POINTER(ctypes.c_void_p)
    if name == 'char':
        return ctypes.c_char_p
    return ctypes.POINTER(struct) if struct else ctypes.c_void_p


def _fields(body: str):
    for declaration in body.split(';'):
        names = re.findall(r'(\w+)(?:\[(\d+)\])?\s*(?:,|$)', declaration)
        for name, count in names:
            kind = _kind(declaration)
            yield name, kind * int(count) if count else kind


for _body, _name in re.findall(r'typedef struct \w+ \{(.*?)\} (\w+);', _TEXT, re.DOTALL):
    setattr(structs, _class_name(_name),
            type(_class_name(_name), (ctypes.Structure,), {'_fields_': list(_fields(_body))}))


def declare(library: ctypes.CDLL) -> None:
    """Adds typed functions to the library: panache_version() as library.version()."""
    for result, name, arguments in re.findall(
            r'PANACHE_API ([\w\s*]+?)\bpanache_(\w+)\(\s*(.*?)\);', _TEXT, re.DOTALL):
        function = getattr(library, 'panache_' + name)
        function.restype = _kind(result)
        function.argtypes = ([] if arguments == 'void' else
                             [_kind(argument) for argument in arguments.split(',')])
        setattr(library, name, function)

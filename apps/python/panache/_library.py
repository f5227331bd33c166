"""The C interface (include/panache/panache.h) through ctypes."""

import ctypes
import operator
import pathlib
from collections.abc import Mapping
from ctypes import byref, c_double, c_float, c_int32, c_void_p, sizeof

import numpy as np

from ._interface import ERROR_KINDS, VERSION, declare, structs

HERE = pathlib.Path(__file__).parent


class PanacheError(Exception):
    """What the library says of bad input, in one sentence. `kind` tells what kind of mistake it is,
    for programs that help with it: one of ERROR_KINDS."""

    def __init__(self, message: str, kind: str = 'other'):
        super().__init__(message)
        self.kind = kind


def _open():
    folder = HERE / 'lib'
    own = folder / 'libpanache.so'
    if not own.exists():
        raise PanacheError(f'there is no {own}; install the wheel that ./run python makes')
    for other in sorted(folder.iterdir()):
        if other != own:  # Dependencies must be loaded before it.
            ctypes.CDLL(str(other), mode=ctypes.RTLD_GLOBAL)
    library = ctypes.CDLL(str(own))
    found = library.panache_version()
    if (found // 10000, found // 100 % 100) != VERSION:
        raise PanacheError(f'{own}: is version {found // 10000}.{found // 100 % 100}; expected '
                           f'{VERSION[0]}.{VERSION[1]}; install the wheel again')
    declare(library)
    return library


lib = _open()


def version() -> str:
    """The library's version: '0.2.0'."""
    number = lib.version()
    return f'{number // 10000}.{number // 100 % 100}.{number % 100}'


def utf8(text, what: str) -> bytes:
    """A name encoded for the library; keeps bytes of a path that are not UTF-8."""
    if not isinstance(text, str):
        raise PanacheError(f'{what}: expected a string, found {type(text).__name__}')
    return text.encode(errors='surrogateescape')


def number(value, what: str) -> float:
    """A number of any type as float."""
    try:
        return float(value)
    except (TypeError, ValueError, OverflowError):
        raise PanacheError(f'{what}: expected a number, found {str(value)[:40]!r}') from None


def whole(value, what: str) -> int:
    """An index or a count."""
    try:
        return operator.index(value)
    except TypeError:
        raise PanacheError(f'{what}: expected a whole number, found {str(value)[:40]!r}') from None


def check(status: int) -> None:
    """Raises the library's last error if `status` is not 0."""
    if status != 0:
        raise last_error()


def last_error() -> PanacheError:
    """The library's last error."""
    return PanacheError(lib.last_error().decode(), ERROR_KINDS[lib.last_error_kind()])


class Handle:
    """An object of the library, destroyed when it is no longer used."""

    def __init__(self, kind: str, create, *arguments):
        self._destroy = getattr(lib, kind + '_destroy')
        self.pointer = c_void_p()
        check(create(*arguments, byref(self.pointer)))

    def __del__(self):
        if getattr(self, 'pointer', None):
            self._destroy(self.pointer)

    def __reduce__(self):  # Copies would be destroyed twice.
        raise TypeError('an object of the library cannot be copied; make another one')

    def view(self, address: int, shape, dtype=np.float32) -> np.ndarray:
        """A read-only array of the library's memory, without a copy; keeps this object alive."""
        dtype = np.dtype(dtype)
        size = int(np.prod(shape)) * dtype.itemsize
        if not size:
            return np.empty(shape, dtype)
        memory = (ctypes.c_char * size).from_address(address)
        memory.owner = self
        out = np.frombuffer(memory, dtype).reshape(shape)
        out.flags.writeable = False
        return out


def take_bytes(create, *arguments) -> bytes:
    """The content of a panache_bytes made by `create`."""
    out = Handle('bytes', create, *arguments)
    return ctypes.string_at(lib.bytes_data(out.pointer), lib.bytes_size(out.pointer))


def floats(array, shape, what: str) -> np.ndarray:
    """`array` as contiguous float32 of this shape (None: any size); copies only if needed."""
    out = np.ascontiguousarray(array, np.float32)
    if out.ndim != len(shape) or any(want not in (None, has)
                                     for want, has in zip(shape, out.shape)):
        wanted = ', '.join('any' if n is None else str(n) for n in shape)
        raise PanacheError(f'{what}: expected an array of shape ({wanted}), found '
                           f'{tuple(out.shape)}')
    return out


def fixed(shape) -> np.ndarray:
    """float32 zeros at a fixed address: the array cannot be resized."""
    size = int(np.prod(shape)) * 4
    return np.frombuffer(bytearray(size), np.float32).reshape(shape)


def mapping(value, what: str):
    """A mapping of names to numbers, checked."""
    if not isinstance(value, Mapping):
        raise PanacheError(f'{what}: expected a dict of names and numbers, found '
                           f'{type(value).__name__}')
    return value


def flag(value, what: str) -> int:
    """A boolean or a count as int."""
    if not isinstance(value, (int, np.integer, np.bool_)):
        raise PanacheError(f'{what}: expected True or False, found {str(value)[:40]!r}')
    return int(value)


def sized(struct, **fields):
    """A struct that begins with its size; converts numeric fields from any type."""
    takes = {c_float: number, c_double: number, c_int32: flag}
    for name, kind in struct._fields_:
        if name in fields and kind in takes:
            fields[name] = takes[kind](fields[name], name)
    return struct(struct_size=sizeof(struct), **fields)


SHAPE = tuple(name for name, _ in structs.Shape._fields_[1:])


def shape_of(amounts) -> structs.Shape:
    """A panache_shape; amounts that are not named are 1."""
    for name in mapping(amounts, 'shape'):
        if name not in SHAPE:
            raise PanacheError(f'there is no amount {name!r} of a shape; expected one of '
                               f'{", ".join(SHAPE)}')
    return sized(structs.Shape, **{name: number(amounts.get(name, 1.0), name) for name in SHAPE})

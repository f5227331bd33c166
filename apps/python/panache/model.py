"""Models."""

import ctypes
import json
import os
import pathlib
from typing import Dict, List, Optional, Union

import numpy as np

from ._files import write
from ._library import (HERE, Handle, PanacheError, check, floats, last_error, lib, number,
                       sized, structs, take_bytes, utf8, whole)

_MODELS = HERE / 'models'
NEUTRAL_BANK = _MODELS / 'neutral.safetensors'  # For learn() from a single clip.
_DEFAULT = 'panache-int8'  # Same as the program's.
_TYPES = {'F32': np.float32, 'F16': np.float16, 'I8': np.int8}


def shipped_models() -> List[str]:
    """The names of the models that come with the package, for `Model(name)`."""
    return sorted(path.stem for path in _MODELS.glob('*.safetensors') if path != NEUTRAL_BANK)


class Model:
    """A trained model: its styles and networks. Immutable; any number of characters and threads may
    share it.

    `source` is the path of a .safetensors file, the name of a shipped model ('panache',
    'panache-int8', ...), the bytes of a file, or None for the shipped default.
    """

    def __init__(self, source: Union[str, os.PathLike, bytes, bytearray, memoryview, None] = None):
        if isinstance(source, (bytes, bytearray, memoryview)):
            self.content = bytes(source)
        elif source is not None and not isinstance(source, (str, os.PathLike)):
            raise PanacheError(f'model: expected a path, a name or bytes, found '
                               f'{type(source).__name__}')
        else:
            name = source or _DEFAULT
            shipped = _MODELS / f'{name}.safetensors'
            path = shipped if shipped.exists() else pathlib.Path(name)
            try:
                self.content = path.read_bytes()
            except OSError as error:
                raise PanacheError(f'{path}: cannot be read: {error.strerror}; the shipped models '
                                   f'are {", ".join(shipped_models()) or "missing"}') from error
        self._handle = Handle('model', lib.model_create, self.content, len(self.content))
        count = lib.model_style_count(self._handle.pointer)
        self.styles: List[str] = [
            lib.model_style_name(self._handle.pointer, i).decode() for i in range(count)]
        """The names of the styles, in the model's order."""
        infos = [sized(structs.StyleInfo) for _ in range(count)]
        for i, info in enumerate(infos):
            check(lib.model_get_style_info(self._handle.pointer, i, info))
        self.groups: List[str] = [info.group.decode() for info in infos]
        """The group of each style, such as 'moods'; '' for learnt ones, and in models without
        groups."""
        self.sides: List[str] = [info.side.decode() for info in infos]
        """The side that each style was captured on, as one sees it: 'right leg', 'to the left'; ''
        if the model does not say."""
        self.gestures: Dict[str, List[str]] = {
            style: [lib.model_gesture_name(self._handle.pointer, i, k).decode()
                    for k in range(infos[i].gesture_count)]
            for i, style in enumerate(self.styles)}
        """The gestures of each style, 'glances left, 1.2 s', for `Character.trigger()`; most
        styles have none."""

        self.person_axes: List[str] = [
            lib.model_person_axis_name(self._handle.pointer, i).decode()
            for i in range(lib.model_person_axis_count(self._handle.pointer))]
        """What each number of a person changes most; empty if the model has no persons."""

    def __reduce__(self):
        return Model, (self.content,)

    def __repr__(self) -> str:
        return f'<panache.Model of {len(self.styles)} styles>'

    def find_style(self, name: str) -> int:
        """The index of a style, by its name or another word for it. Raises PanacheError if there is
        none."""
        place = lib.model_find_style(self._handle.pointer, utf8(name, 'style'))
        if place < 0:
            raise last_error()
        return place

    def find_side(self, style: str, side: Union[float, str]) -> float:
        """A side of a style as a number: 1 as captured to -1 mirrored. Words are 'captured',
        'mirrored' and, if `sides` says which was captured, 'left' and 'right'."""
        if not isinstance(side, str):
            side = number(side, f'side of {style}')
            if not -1 <= side <= 1:
                raise PanacheError(f'side of {style}: expected -1 to 1, found {side:g}')
            return side
        found = ctypes.c_float()
        check(lib.model_find_side(self._handle.pointer, self.find_style(style), utf8(side, 'side'),
                                  ctypes.byref(found)))
        return found.value

    def person(self, who: Union[int, str, np.ndarray], amount: float = 1) -> np.ndarray:
        """The numbers of a person: of a seed (a number or a word; '7' is the number), or given,
        [person_axes]; `amount` times as far from the mean person, 0 to 2. Real people are
        distributed like standard normal numbers."""
        axes = len(self.person_axes)
        if isinstance(who, (str, int, np.integer)):
            seed = (lib.person_seed(utf8(who, 'person')) if isinstance(who, str)
                    else whole(who, 'person'))
            if not 0 <= seed < 2 ** 32:
                raise PanacheError(f'person: expected a seed of 0 to {2 ** 32 - 1}, found {seed}')
            numbers = np.zeros(max(axes, 1), np.float32)
            check(lib.model_draw_person(self._handle.pointer, seed, numbers.ctypes.data, axes))
            numbers = numbers[:axes]
        else:
            numbers = floats(who, (axes,), 'person')
        return numbers * np.float32(number(amount, 'amount'))

    def _header(self) -> dict:
        size = int.from_bytes(self.content[:8], 'little')
        return json.loads(self.content[8:8 + size])

    @property
    def metadata(self) -> Dict[str, str]:
        """The metadata of the file: recipe, data, licence, ..."""
        return self._header().get('__metadata__', {})

    def tensors(self) -> Dict[str, np.ndarray]:
        """The tensors of the file by name, weights as [inputs, outputs]: float32, float16, or int8
        with a matching `.scale`. Read-only views of `content`; no copies."""
        begin = 8 + int.from_bytes(self.content[:8], 'little')
        out = {}
        for name, entry in self._header().items():
            if name != '__metadata__':
                first, last = entry['data_offsets']
                data = memoryview(self.content)[begin + first:begin + last]
                out[name] = np.frombuffer(data, _TYPES[entry['dtype']]).reshape(entry['shape'])
        return out

    def save(self, path: Union[str, os.PathLike], force: bool = False) -> None:
        """Writes the model's file atomically; overwrites an existing one only with `force`."""
        write(path, self.content, force)

    def extract(self, style: str) -> bytes:
        """The style file of a style, for `add()` and `panache styles --add`."""
        return take_bytes(lib.styles_extract, self.content, len(self.content), utf8(style, 'style'))

    def add(self, style_file: bytes, replace: bool = False) -> 'Model':
        """A copy of the model with the style of a style file. Other styles stay bit-identical."""
        return Model(take_bytes(lib.styles_add, self.content, len(self.content), style_file,
                                len(style_file), replace))

    def remove(self, style: str) -> 'Model':
        """A copy of the model without a style."""
        return Model(take_bytes(lib.styles_remove, self.content, len(self.content),
                                utf8(style, 'style')))


def model_of(model: Optional[Model]) -> Model:
    """The model, or the shipped default."""
    return Model() if model is None else model

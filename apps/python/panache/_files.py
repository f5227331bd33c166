"""Bytes from and to files."""

import os
import pathlib
import tempfile

from ._library import PanacheError


def read_bytes(path) -> bytes:
    """All of a file."""
    try:
        return pathlib.Path(path).read_bytes()
    except OSError as error:
        raise PanacheError(f'{path}: cannot be read: {error.strerror}') from error


def check_free(path, force: bool) -> None:
    """Before any work is done: raises where a file would be overwritten."""
    if not force and os.path.exists(path):
        raise PanacheError(f'{path}: exists already; force=True overwrites it')


def write(path, content: bytes, force: bool) -> None:
    """Puts a file at `path`, whole or not at all: writes beside it, then renames."""
    check_free(path, force)
    path = pathlib.Path(path)
    part = None
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.NamedTemporaryFile(dir=path.parent, prefix=path.name + '.',
                                         delete=False) as file:
            part = file.name
            file.write(content)
        mask = os.umask(0)
        os.umask(mask)
        os.chmod(part, 0o666 & ~mask)
        os.replace(part, path)
    except OSError as error:
        if part and os.path.exists(part):
            os.unlink(part)
        raise PanacheError(f'{path}: cannot be written: {error.strerror}') from error

"""Bytes from and to files."""

import itertools
import os
import pathlib
import stat

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
        raise _taken(path)


def write(path, content: bytes, force: bool) -> None:
    """Puts a file at `path`, whole or not at all: writes a new one beside it, then renames. As the
    program does: a replaced file keeps its permissions, and where a link points is written to."""
    check_free(path, force)
    part = None
    try:
        target = os.path.realpath(path)
        permissions = _permissions(target, path)
        os.makedirs(os.path.dirname(target), exist_ok=True)
        part, handle = _create_beside(target)
        with os.fdopen(handle, 'wb') as file:
            file.write(content)
        if permissions is not None:
            os.chmod(part, permissions)
        _rename(part, target, force)
        part = None  # Another thread may have made a new one of this name.
    except FileExistsError as error:
        raise _taken(path) from error
    except OSError as error:
        raise PanacheError(f'{path}: cannot be written: {error.strerror}') from error
    finally:
        if part and os.path.exists(part):
            os.unlink(part)


def _taken(path) -> PanacheError:
    return PanacheError(f'{path}: exists already; force=True overwrites it')


def _permissions(target: str, path):
    """Of a file that is there; None where there is none. Nothing but a file is replaced."""
    try:
        mode = os.stat(target).st_mode
    except FileNotFoundError:
        return None
    if stat.S_ISDIR(mode):
        raise PanacheError(f'{path}: is a folder; expected a file name')
    if not stat.S_ISREG(mode):
        raise PanacheError(
            f'{path}: is a device, pipe or socket, which is not replaced; expected a file name')
    return stat.S_IMODE(mode)


def _create_beside(target: str):
    """The name and handle of a new file: .NAME.PID.part, as the program calls it."""
    folder, name = os.path.split(target)
    stem = os.fsdecode(os.fsencode('.' + name)[:255 - len('.PID4567-1000.part')])
    how = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, 'O_BINARY', 0)
    for i in itertools.count(1):
        again = '' if i == 1 else f'-{i}'
        part = os.path.join(folder, f'{stem}.{os.getpid()}{again}.part')
        try:
            return part, os.open(part, how, 0o666)
        except FileExistsError:
            if i == 1000:
                raise


def _rename(part: str, target: str, force: bool) -> None:
    if not force:
        if os.name == 'nt':
            return os.rename(part, target)  # Replaces nothing there.
        try:
            os.link(part, target)  # Replaces nothing anywhere.
            return os.unlink(part)
        except FileExistsError:
            raise
        except OSError:  # A file system without links.
            if os.path.exists(target):
                raise FileExistsError() from None
    os.replace(part, target)

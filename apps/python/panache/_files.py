"""Reads and writes files."""

import itertools
import os
import pathlib
import stat

from ._library import PanacheError


def read_bytes(path) -> bytes:
    """The content of a file."""
    try:
        return pathlib.Path(path).read_bytes()
    except OSError as error:
        raise PanacheError(f'{path}: cannot be read: {error.strerror}') from error


def check_free(path, force: bool) -> None:
    """Raises if a file would be overwritten; call before any work is done."""
    if not force and os.path.exists(path):
        raise _taken(path)


def write(path, content: bytes, force: bool) -> None:
    """Writes a file atomically: writes a new file next to it, then renames that. As in the program,
    a replaced file keeps its permissions, and a link is followed."""
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
        part = None  # Another thread may now use this name.
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
    """The permissions of an existing file; None without one. Raises if it is not a file."""
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
    """The path and handle of a new file, .NAME.PID.part as in the program."""
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
            return os.rename(part, target)  # Never overwrites on Windows.
        try:
            os.link(part, target)  # Never overwrites.
            return os.unlink(part)
        except FileExistsError:
            raise
        except OSError:  # The file system has no links.
            if os.path.exists(target):
                raise FileExistsError() from None
    os.replace(part, target)

# SPDX-License-Identifier: Apache-2.0
"""Temporary files for other processes, removed with the last listener or at exit."""

from __future__ import annotations

import atexit
from collections.abc import Callable
import os

Listener = Callable[[str], None]

_paths: list[str] = []
_listeners: list[Listener] = []


class FileListening:
    """
    Subscription to the temporary files; when the last one is closed, they are removed.

    Parameters
    ----------
    listener
        Called with the path of each existing file, and of each new one before it is created.

    """

    def __init__(self, listener: Listener) -> None:
        self._listener = listener
        _listeners.append(listener)
        for path in _paths:
            listener(path)

    def close(self) -> None:
        """Cancel the subscription; if it was the last one, remove all temporary files."""
        _listeners.remove(self._listener)
        if not _listeners:
            _remove_all()


def write_temporary_file(prefix: str, text: str) -> str:
    """
    Write a temporary file, which is removed with the last listener or at exit.

    Parameters
    ----------
    prefix
        The prefix of its name, before random digits.
    text
        The content, which is written as UTF-8.

    Returns
    -------
    str
        The absolute path of the file, which only its owner may read.

    """
    if not _paths:
        atexit.register(_remove_all)
    path = os.path.join(_folder(), f'{prefix}{os.urandom(6).hex()}')
    _paths.append(path)
    for listener in _listeners:
        listener(path)
    descriptor = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, 0o600)
    with open(descriptor, 'wb') as file:
        file.write(text.encode())
    return path


def is_temporary_file(path: str) -> bool:
    """
    Whether a file was created by `write_temporary_file` and still exists.

    Parameters
    ----------
    path
        The path that it returned.

    """
    return path in _paths


def _folder() -> str:
    """Return the temporary directory, usually without importing the large module `tempfile`."""
    for folder in (*map(os.environ.get, ('TMPDIR', 'TEMP', 'TMP')), '/tmp'):
        if folder and os.path.isdir(folder) and os.access(folder, os.W_OK | os.X_OK):
            return os.path.abspath(folder)
    import tempfile

    return tempfile.gettempdir()


def _remove_all() -> None:
    atexit.unregister(_remove_all)
    for path in _paths:
        try:
            os.unlink(path)
        except OSError:
            pass  # someone has removed it already
    _paths.clear()

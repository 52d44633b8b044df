# SPDX-License-Identifier: Apache-2.0
"""Atomic file writing: after a failure, the old file is still intact."""

from __future__ import annotations

from contextlib import suppress
import os
import stat
import tempfile

from rviz_common.config.config_error import ConfigError

__all__ = ['replace_file']


def replace_file(path: str, text: str) -> None:
    """
    Replace the contents of a file atomically, preserving its permissions.

    Parameters
    ----------
    path
        The file. If it is a symbolic link, its target is replaced.
    text
        The new contents, written as UTF-8.

    Raises
    ------
    ConfigError
        The file cannot be written; it is left unchanged.

    """
    path = os.path.realpath(path)  # the target of a link, not the link itself
    try:
        _replace(path, text.encode())
    except OSError as error:
        raise ConfigError(
            path, None, f'The file cannot be written: {error.strerror}. It is as it was.'
        ) from error


def _replace(path: str, content: bytes) -> None:
    directory, name = os.path.split(path)
    handle, temporary = tempfile.mkstemp(prefix=f'.{name}.', dir=directory)
    try:
        with open(handle, 'wb') as file:
            os.fchmod(handle, _mode(path))
            file.write(content)
            file.flush()
            os.fsync(handle)
        os.replace(temporary, path)
    except BaseException:
        with suppress(OSError):
            os.unlink(temporary)
        raise


def _mode(path: str) -> int:
    """Return the permissions of the existing file, or those of a new one."""
    with suppress(OSError):
        return stat.S_IMODE(os.stat(path).st_mode)
    mask = os.umask(0)
    os.umask(mask)
    return 0o666 & ~mask

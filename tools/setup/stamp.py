# SPDX-License-Identifier: Apache-2.0
"""Stamps of build results: digests of their sources, to detect changes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
import hashlib
import os
from pathlib import Path

IGNORED = {'__pycache__', '.pytest_cache', '.mypy_cache', '.ruff_cache', 'test'}


def files_below(folder: Path) -> Iterator[str]:
    """
    List the files below a folder, sorted, without caches and tests.

    Parameters
    ----------
    folder
        The folder to search.

    Yields
    ------
    str
        The path of each file, which starts with the folder.

    """
    for base, folders, files in os.walk(folder):
        folders[:] = sorted(name for name in folders if name not in IGNORED)
        yield from (os.path.join(base, name) for name in sorted(files))


def digest(paths: Iterable[str | Path], *more: str) -> str:
    """
    Compute a digest of the names and contents of files, and of further strings.

    Parameters
    ----------
    paths
        The files; their order matters.
    *more
        The strings.

    Returns
    -------
    str
        A SHA-256 digest in hexadecimal.

    """
    total = hashlib.sha256('\0'.join(more).encode())
    for path in paths:
        total.update(os.fsencode(path) + b'\0')
        total.update(hashlib.sha256(Path(path).read_bytes()).digest())
    return total.hexdigest()


class Stamp:
    """
    The digest of the sources that a result was made from; absent while it is being made.

    Parameters
    ----------
    path
        The file with the digest, which need not exist yet.

    """

    def __init__(self, path: Path) -> None:
        self._path = path

    def matches(self, current: str) -> bool:
        """
        Whether the result is complete and was made from these sources.

        Parameters
        ----------
        current
            The digest of the sources as they are now.

        """
        try:
            return self._path.read_text() == current
        except OSError:
            return False

    def exists(self) -> bool:
        """Check whether the result is complete, from these sources or others."""
        return self._path.exists()

    def clear(self) -> None:
        """Delete the stamp while the result is being made, in case of an interruption."""
        self._path.unlink(missing_ok=True)

    def write(self, current: str) -> None:
        """
        Record that the result is complete.

        Parameters
        ----------
        current
            The digest of the sources that it was made from.

        """
        self._path.parent.mkdir(parents=True, exist_ok=True)
        self._path.write_text(current)

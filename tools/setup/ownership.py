# SPDX-License-Identifier: Apache-2.0
"""Ownership of an environment: only its own workspace may change or delete it."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
import shutil
import sys

from console import SetupError
from locations import cache_folder, Locations
from stamp import Stamp


def python_version() -> str:
    """Return the running Python's minor version, as in 3.12."""
    return f'{sys.version_info[0]}.{sys.version_info[1]}'


class Home:
    """
    The record in an environment of the workspace, the path and the Python it was made for.

    Parameters
    ----------
    locations
        The workspace and its environment, which need not exist yet.

    """

    def __init__(self, locations: Locations) -> None:
        self._locations = locations
        self._path = locations.environment / 'stamp' / 'home'
        self._text = f'{locations.root}\n{locations.environment}\n{python_version()}'

    def write(self) -> None:
        """Record that the environment is made for this workspace."""
        Stamp(self._path).write(self._text)

    def require_same(self) -> None:
        """Reject an environment that was moved, or made for another workspace or Python."""
        if not self._path.exists() or Stamp(self._path).matches(self._text):
            return
        environment = self._locations.environment
        other = self.other_workspace()
        if other:
            raise SetupError(
                f'The environment in {environment} belongs to the workspace in {other}: '
                f'{self._advice()}'
            )
        raise SetupError(
            f'The environment in {environment} was made for a workspace in another place or by '
            f'a Python other than {python_version()}, and its programs refer to those: '
            f'{self._advice()}'
        )

    def other_workspace(self) -> Path | None:
        """Return the other workspace that the environment belongs to, if it still exists."""
        try:
            root = Path(self._path.read_text().splitlines()[0])
        except (OSError, IndexError):
            return None
        is_other = root != self._locations.root and (root / 'tools' / 'setup').is_dir()
        return root if is_other else None

    def is_deleted_with_the_workspace(self) -> bool:
        """Check whether the set-up placed the environment, for this workspace only."""
        locations = self._locations
        is_placed = not locations.is_elsewhere or locations.environment.parent == cache_folder()
        return is_placed and self.other_workspace() is None

    def _advice(self) -> str:
        """Explain how to make a separate environment, without affecting another workspace."""
        if self.is_deleted_with_the_workspace():
            return 'run `make distclean setup` to recreate it'
        if self._locations.is_linked:
            return (
                'choose another VENV, as in: make setup VENV=/opt/venv; or run '
                '`make distclean setup`, which leaves that one alone'
            )
        return 'choose another VENV, as in: make setup VENV=/opt/venv'


def remove(paths: Iterable[Path]) -> None:
    """
    Delete folders, if they exist.

    Parameters
    ----------
    paths
        The folders; files are left alone.

    """
    for path in paths:
        if path.is_dir():
            shutil.rmtree(path)


def refuse_what_belongs_to_others(locations: Locations) -> None:
    """
    Check that no other workspace owns an environment that is to be deleted.

    Parameters
    ----------
    locations
        The workspace and its environment.

    Raises
    ------
    SetupError
        It belongs to another workspace, and .venv is not a link to it.

    """
    other = Home(locations).other_workspace()
    if other and not locations.is_linked:
        raise SetupError(
            f'The environment in {locations.environment} belongs to the workspace in {other}: '
            'run `make distclean` there, or here without VENV'
        )


def forget_environment(locations: Locations) -> None:
    """
    Delete the environment if the set-up placed it; if the user named it, only the link.

    Parameters
    ----------
    locations
        The workspace and its environment.

    """
    if Home(locations).is_deleted_with_the_workspace():
        remove([locations.environment])
    else:
        print(f'The environment in {locations.environment} was chosen by you and is kept.')
    if locations.link.is_symlink():
        locations.link.unlink()

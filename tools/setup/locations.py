# SPDX-License-Identifier: Apache-2.0
"""The folders of the workspace: the environment is always reached as .venv, wherever it is."""

from __future__ import annotations

from dataclasses import dataclass
import hashlib
import os
from pathlib import Path

from console import SetupError

LONGEST_SHEBANG = 127
OWN_MARK = 'humanoid-workspace'


@dataclass(frozen=True)
class Locations:
    """The folders of a workspace.

    root: the workspace; link: its .venv; environment: the real folder behind .venv, whose path
    has no space, because the first line of a script and colcon's set-up files cannot hold one.
    """

    root: Path
    link: Path
    environment: Path

    @property
    def python(self) -> Path:
        """The environment's interpreter."""
        return self.environment / 'bin' / 'python3'

    @property
    def underlay(self) -> Path:
        """The sources of the underlay."""
        return self.root / 'tools' / 'underlay'

    @property
    def is_elsewhere(self) -> bool:
        """Whether .venv is, or has to be, a link to the environment."""
        return self.environment != self.link

    @property
    def is_linked(self) -> bool:
        """Whether .venv is a link to this environment."""
        real = os.path.realpath
        return self.link.is_symlink() and real(self.link) == real(self.environment)


def find_locations(root: Path, wanted: str | None) -> Locations:
    """
    Locate the environment: as requested, at its current place, in .venv, or in the cache.

    Parameters
    ----------
    root
        The folder of the workspace.
    wanted
        The environment that the user named, if any.

    Returns
    -------
    Locations
        The folders; the environment need not exist yet.

    Raises
    ------
    SetupError
        .venv holds another environment than the requested one, scripts cannot name the
        interpreter in their first line, or there is no such home folder.

    """
    link = root / '.venv'
    if wanted:
        environment = Path(os.path.realpath(expanded_path(wanted)))
        if link.is_dir() and not link.is_symlink() and environment != link:
            raise SetupError(
                f'{link} already holds an environment, so VENV={wanted} cannot take its place: '
                'run `make distclean` first'
            )
    elif link.is_symlink():
        environment = Path(os.readlink(link))
    elif fits_in_shebang(link):
        environment = link
    else:
        environment = cache_folder() / hashlib.sha256(os.fsencode(root)).hexdigest()[:12]
    if not fits_in_shebang(environment):
        raise SetupError(
            f'The environment cannot be in {environment}: the path has a space or is too long '
            'for the first line of a script. Keep it elsewhere, as in: make setup VENV=/opt/venv'
        )
    return Locations(root, link, environment)


def expanded_path(given: str) -> Path:
    """
    Replace `~` or `~user` at the beginning of a path by that home folder.

    Parameters
    ----------
    given
        The path as the user gave it.

    Raises
    ------
    SetupError
        There is no such home folder.

    """
    try:
        return Path(given).expanduser()
    except RuntimeError:
        raise SetupError(
            f"There is no home folder '{Path(given).parts[0]}': give the whole path instead of "
            f"'{given}', from / on"
        ) from None


def fits_in_shebang(environment: Path) -> bool:
    """
    Whether scripts can name the environment's interpreter in their first line.

    Parameters
    ----------
    environment
        The environment, whose path must not be too long or contain white space.

    """
    line = f'#!{environment}/bin/python3'
    return len(os.fsencode(line)) <= LONGEST_SHEBANG and not any(c.isspace() for c in line)


def cache_folder() -> Path:
    """Return the folder for environments that cannot be in their workspace."""
    base = os.environ.get('XDG_CACHE_HOME') or Path.home() / '.cache'
    return Path(base) / OWN_MARK


def link_environment(locations: Locations) -> None:
    """
    Make .venv a link to an environment elsewhere.

    Parameters
    ----------
    locations
        The workspace and its environment; nothing is done if that is .venv itself.

    """
    if not locations.is_elsewhere:
        return
    if locations.link.is_symlink():
        locations.link.unlink()
    locations.link.symlink_to(locations.environment)

# SPDX-License-Identifier: Apache-2.0
"""The installed distributions, and those pinned by a workspace."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from importlib.metadata import distributions
from pathlib import Path
import re
import shlex

from ros2doctor.facts.prefix import environment_prefix, python_version

REQUIREMENTS = 'requirements.txt'
STAMPS = ('wheels', 'underlay')
PIN = re.compile(r'^([A-Za-z0-9._-]+)==([^ ;]+)(?: *; *(.*))?$')


@dataclass(frozen=True)
class Wheels:
    """
    Versions by name of distribution.

    :param root: the workspace whose requirements.txt has the pins; None if there is none
    :param install_again: the command that installs what is pinned
    """

    installed: Mapping[str, str]
    pinned: Mapping[str, str]
    root: Path | None
    install_again: str


def read_wheels() -> Wheels:
    """Return the installed versions, and those pinned by the workspace of this environment."""
    root = _root()
    text = (root / REQUIREMENTS).read_text(encoding='utf-8') if root else ''
    installed = {
        normal_name(item.metadata['Name']): item.version
        for item in reversed(list(distributions()))
        if item.metadata['Name']
    }
    return Wheels(installed, pins(text), root, install_command())


def install_command() -> str:
    """Return the command that reinstalls the pinned versions, even if the setup seems complete."""
    root, environment = _root(), Path(environment_prefix())
    if root is None:
        return 'install the wheels of your environment again, with python3 -m pip'
    if root != _home():  # after a move a new environment is required
        return f'make -C {shlex.quote(str(root))} distclean build'
    stamps = ' '.join(shlex.quote(str(environment / 'stamp' / name)) for name in STAMPS)
    elsewhere = environment.resolve() != (root / '.venv').resolve()
    place = f' VENV={shlex.quote(str(environment))}' if elsewhere else ''
    return f'rm -f {stamps} && make -C {shlex.quote(str(root))} setup{place}'


def pins(requirements: str) -> dict[str, str]:
    """
    Parse the pinned versions (`==`) of a requirements file.

    Parameters
    ----------
    requirements
        The text of the file; lines of another form, or whose marker excludes the environment's
        Python, are skipped.

    Returns
    -------
    dict
        The versions by normalised name of the distribution.

    """
    python = python_version()
    found = (match.groups() for match in map(PIN.match, requirements.splitlines()) if match)
    return {
        normal_name(name): version for name, version, marker in found if _applies(marker, python)
    }


def normal_name(name: str) -> str:
    """
    Normalise the name of a distribution, as pip does to compare names.

    Parameters
    ----------
    name
        The name, as in `ros_Jazzy.rclpy`.

    Returns
    -------
    str
        The name in lower case, with single hyphens, as `ros-jazzy-rclpy`.

    """
    return re.sub(r'[-_.]+', '-', name).lower()


def _applies(marker: str | None, python: str) -> bool:
    if not marker:
        return True
    try:
        from packaging.markers import Marker
    except ImportError:
        return False
    minor = python.rpartition('.')[0]
    return Marker(marker).evaluate({'python_full_version': python, 'python_version': minor})


def _root() -> Path | None:
    """Return the workspace that created this environment, even if both were moved together."""
    home = _home()
    candidates = (home, Path(environment_prefix()).parent) if home else ()
    return next((root for root in candidates if (root / REQUIREMENTS).is_file()), None)


def _home() -> Path | None:
    """Return the original path of the workspace that created this environment, if any."""
    try:
        text = Path(environment_prefix(), 'stamp', 'home').read_text(encoding='utf-8')
    except OSError:
        return None
    return Path(text.split('\n')[0])

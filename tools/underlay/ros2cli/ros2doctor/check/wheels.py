# SPDX-License-Identifier: Apache-2.0
"""Find the environment that has the wheels, and check that their versions match."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache
from importlib.metadata import distributions
import os
from pathlib import Path
import platform
import re
import shlex
import sys

from ros2doctor.api.extension import DoctorCheck, DoctorReport, Finding, Report, Result, Severity
from ros_environment.installed import prefixes
from ros_environment.suggestions import listing

MARKER = 'pyvenv.cfg'
VERSION = re.compile(r'^version(?:_info)? *= *(\d+\.\d+\.\d+)', re.MULTILINE)
REQUIREMENTS = 'requirements.txt'
STAMPS = ('wheels', 'underlay')
PIN = re.compile(r'^([A-Za-z0-9._-]+)==([^ ;]+)(?: *; *(.*))?$')
ROS_PREFIX = 'ros-'
LAST_SETUPTOOLS = 79


@lru_cache(maxsize=1)
def environment_prefix() -> str:
    """Return the environment that was sourced; without one that of the running Python."""
    sourced = (str(prefix) for prefix in prefixes() if (prefix / MARKER).is_file())
    return next(sourced, sys.prefix)


def python_version() -> str:
    """Return the version of the environment's Python, which need not be the running one."""
    marker = Path(environment_prefix(), MARKER)
    text = marker.read_text(encoding='utf-8') if marker.is_file() else ''
    found = VERSION.search(text)
    return found[1] if found else platform.python_version()


def is_own(program: str) -> bool:
    """
    Check whether a program is in the `bin` folder of the environment.

    Folders are compared, because the Python of an environment is a link to that of the system.

    Parameters
    ----------
    program
        The path of the program, which itself may be a link.

    Returns
    -------
    bool
        Whether it is.

    """
    own = os.path.join(environment_prefix(), 'bin')
    return os.path.realpath(os.path.dirname(program)) == os.path.realpath(own)


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


class WheelsCheck(DoctorCheck):
    """Check of the versions of the wheels."""

    def category(self) -> str:
        """Return the category."""
        return 'wheels'

    def check(self) -> Result:
        """Check for wheels that are missing or of an untested version."""
        return Result(wheel_findings(read_wheels()))


def wheel_findings(facts: Wheels) -> Iterator[Finding]:
    """
    Compare the installed wheels with the pinned ones.

    Parameters
    ----------
    facts
        The versions, as `read_wheels` gives them; without pins only setuptools is examined.

    Yields
    ------
    Finding
        An error for missing wheels and for wheels of ROS of another version, a warning for others.

    """
    missing = sorted(set(facts.pinned) - set(facts.installed))
    if missing:
        yield Finding(
            Severity.ERROR,
            f'wheels are missing: {listing(missing)}',
            'programs that need them fail with an ImportError',
            facts.install_again,
        )
    yield from _other_versions(facts)
    if not facts.pinned:
        yield from _setuptools(facts)


def _other_versions(facts: Wheels) -> Iterator[Finding]:
    others = {
        name: f'{name} {facts.installed[name]} instead of {version}'
        for name, version in sorted(facts.pinned.items())
        if facts.installed.get(name, version) != version
    }
    ros = [text for name, text in others.items() if name.startswith(ROS_PREFIX)]
    if ros:
        yield Finding(
            Severity.ERROR,
            f'the versions of the ROS wheels do not match: {listing(ros)}',
            'their libraries were compiled for each other: others crash or do not load',
            facts.install_again,
        )
    rest = [text for name, text in others.items() if not name.startswith(ROS_PREFIX)]
    if rest:
        yield Finding(
            Severity.WARNING,
            f'wheels have versions other than the tested ones: {listing(rest)}',
            'builds and programs may behave differently from those of other people',
            facts.install_again,
        )


def _setuptools(facts: Wheels) -> Iterator[Finding]:
    """Check the setuptools version, which matters in every workspace, even without pins."""
    version = facts.installed.get('setuptools', '0')
    if int(version.partition('.')[0]) > LAST_SETUPTOOLS:
        yield Finding(
            Severity.WARNING,
            f'setuptools is {version}',
            'from version 80 on, `colcon build --symlink-install` fails',
            "python3 -m pip install 'setuptools<80'",
        )


class WheelsReport(DoctorReport):
    """Report of the versions of the wheels."""

    def category(self) -> str:
        """Return the category."""
        return 'wheels'

    def report(self) -> Report:
        """Return the section."""
        facts = read_wheels()
        report = Report('PACKAGE VERSIONS')
        report.add_to_report('pinned by', facts.root / 'requirements.txt' if facts.root else None)
        for name in sorted({*facts.installed, *facts.pinned}):
            version = facts.installed.get(name, 'missing')
            pinned = facts.pinned.get(name, version)
            text = version if pinned == version else f'{version} instead of {pinned}'
            report.add_to_report(name, text)
        return report

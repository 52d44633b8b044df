# SPDX-License-Identifier: Apache-2.0
"""Check that the versions of the installed wheels match."""

from __future__ import annotations

from collections.abc import Iterator

from ros2doctor.api.extension import DoctorCheck
from ros2doctor.api.finding import Finding, Result, Severity
from ros2doctor.facts.wheels import read_wheels, Wheels
from ros_environment.advice import listing

ROS_PREFIX = 'ros-'
LAST_SETUPTOOLS = 79


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
            'what needs them ends with an ImportError',
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
            f'wheels of ROS have versions that do not belong together: {listing(ros)}',
            'their libraries were compiled for each other: others crash or do not load',
            facts.install_again,
        )
    rest = [text for name, text in others.items() if not name.startswith(ROS_PREFIX)]
    if rest:
        yield Finding(
            Severity.WARNING,
            f'wheels have other versions than the tested ones: {listing(rest)}',
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

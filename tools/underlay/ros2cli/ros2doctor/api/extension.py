# SPDX-License-Identifier: Apache-2.0
"""The base classes of checks and reports."""

from __future__ import annotations

from ros2doctor.api.finding import Result
from ros2doctor.api.report import Report


class DoctorCheck:
    """A check: what it belongs to, and what it finds."""

    def category(self) -> str:
        """Return what the check is about, in a word; the report of that name tells more."""
        raise NotImplementedError(f'{type(self).__name__} does not implement category()')

    def check(self) -> Result:
        """Return what was found."""
        raise NotImplementedError(f'{type(self).__name__} does not implement check()')


class DoctorReport:
    """A section of `ros2 doctor --report`."""

    def category(self) -> str:
        """Return what the report is about, in a word; the check of that name judges it."""
        raise NotImplementedError(f'{type(self).__name__} does not implement category()')

    def report(self) -> Report:
        """Return the section."""
        raise NotImplementedError(f'{type(self).__name__} does not implement report()')

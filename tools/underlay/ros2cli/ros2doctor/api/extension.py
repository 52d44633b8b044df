# SPDX-License-Identifier: Apache-2.0
"""Base classes of checks and reports."""

from __future__ import annotations

from ros2doctor.api.finding import Result
from ros2doctor.api.report import Report


class DoctorCheck:
    """Base class of a check: its category and its findings."""

    def category(self) -> str:
        """Return the category, in one word; the report of the same name has details."""
        raise NotImplementedError(f'{type(self).__name__} does not implement category()')

    def check(self) -> Result:
        """Run the check and return its findings."""
        raise NotImplementedError(f'{type(self).__name__} does not implement check()')


class DoctorReport:
    """A section of `ros2 doctor --report`."""

    def category(self) -> str:
        """Return the category, in one word; the check of the same name evaluates it."""
        raise NotImplementedError(f'{type(self).__name__} does not implement category()')

    def report(self) -> Report:
        """Return the section."""
        raise NotImplementedError(f'{type(self).__name__} does not implement report()')

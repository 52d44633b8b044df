# SPDX-License-Identifier: Apache-2.0
"""Base classes of checks and reports, and what these return: findings and sections."""

from __future__ import annotations

from collections.abc import Iterable
from enum import Enum
from typing import NamedTuple


class Severity(Enum):
    """Severity of a finding: an error means that something does not work."""

    ERROR = 'ERROR'
    WARNING = 'WARNING'


class Finding(NamedTuple):
    """
    A problem found by a check.

    :param what: what is wrong, in one sentence
    :param why: what does not work because of it
    :param mend: the command, or the change, that fixes it
    """

    severity: Severity
    what: str
    why: str = ''
    mend: str = ''


class Result:
    """
    The findings of a check.

    Parameters
    ----------
    findings
        The initial findings; an iterator is exhausted at once.

    """

    def __init__(self, findings: Iterable[Finding] = ()) -> None:
        self.findings = list(findings)

    @property
    def error(self) -> int:
        """Return the number of errors."""
        return self._count(Severity.ERROR)

    @property
    def warning(self) -> int:
        """Return the number of warnings."""
        return self._count(Severity.WARNING)

    def add_error(self, error_msg: str, why: str = '', mend: str = '') -> None:
        """
        Add a finding about something that does not work.

        Parameters
        ----------
        error_msg
            What is wrong, in one sentence.
        why
            What does not work because of it.
        mend
            The command, or the change, that fixes it.

        """
        self.findings.append(Finding(Severity.ERROR, error_msg, why, mend))

    def add_warning(self, warn_msg: str, why: str = '', mend: str = '') -> None:
        """
        Add a finding about something that may cause trouble.

        Parameters
        ----------
        warn_msg, why, mend
            As for `add_error`.

        """
        self.findings.append(Finding(Severity.WARNING, warn_msg, why, mend))

    def _count(self, severity: Severity) -> int:
        return sum(finding.severity is severity for finding in self.findings)


class Report:
    """
    A section of the report: a title with named items.

    Parameters
    ----------
    name
        The title.

    Attributes
    ----------
    items
        The lines in their order, each a name and a text.

    """

    def __init__(self, name: str) -> None:
        self.name = name
        self.items: list[tuple[str, str]] = []

    def add_to_report(self, item_name: str, item_info: object) -> None:
        """
        Add a line to the section.

        Parameters
        ----------
        item_name
            The left column; several lines may have the same name.
        item_info
            The right column, converted by `str`.

        """
        self.items.append((item_name, str(item_info)))


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

# SPDX-License-Identifier: Apache-2.0
"""What a check finds."""

from __future__ import annotations

from collections.abc import Iterable
from enum import Enum
from typing import NamedTuple


class Severity(Enum):
    """How bad a finding is: with an error something does not work."""

    ERROR = 'ERROR'
    WARNING = 'WARNING'


class Finding(NamedTuple):
    """
    Something that is wrong.

    :param what: what is wrong, in one sentence
    :param why: what does not work because of it
    :param mend: the command, or the change, that mends it
    """

    severity: Severity
    what: str
    why: str = ''
    mend: str = ''


class Result:
    """All that a check has found."""

    def __init__(self, findings: Iterable[Finding] = ()) -> None:
        """Begin with some findings."""
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
        """Add something that does not work."""
        self.findings.append(Finding(Severity.ERROR, error_msg, why, mend))

    def add_warning(self, warn_msg: str, why: str = '', mend: str = '') -> None:
        """Add something that may cause trouble."""
        self.findings.append(Finding(Severity.WARNING, warn_msg, why, mend))

    def _count(self, severity: Severity) -> int:
        return sum(finding.severity is severity for finding in self.findings)

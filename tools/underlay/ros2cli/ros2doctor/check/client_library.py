# SPDX-License-Identifier: Apache-2.0
"""Check that nodes can start at all."""

from __future__ import annotations

from collections.abc import Iterator

from ros2doctor.api.extension import DoctorCheck
from ros2doctor.api.finding import Finding, Result, Severity
from ros2doctor.facts.client_library import why_rclpy_does_not_start
from ros2doctor.facts.wheels import install_command


class ClientLibraryCheck(DoctorCheck):
    """Check of rclpy by using it."""

    def category(self) -> str:
        """Return the category."""
        return 'rclpy'

    def check(self) -> Result:
        """Check whether nodes can start."""
        return Result(client_library_findings(why_rclpy_does_not_start(), install_command()))


def client_library_findings(why_not: str, install_again: str) -> Iterator[Finding]:
    """
    Report an error if rclpy does not start.

    Parameters
    ----------
    why_not
        The reason, as `why_rclpy_does_not_start` gives it; '' if rclpy starts.
    install_again
        The command that installs the wheels again, which the finding suggests.

    Yields
    ------
    Finding
        At most one.

    """
    if why_not:
        yield Finding(
            Severity.ERROR,
            f'rclpy does not start: {why_not}',
            'no Python node can start; the running nodes were not examined',
            f'mend the errors above first; if there are none: {install_again}',
        )

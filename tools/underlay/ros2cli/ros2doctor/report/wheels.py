# SPDX-License-Identifier: Apache-2.0
"""The installed distributions."""

from __future__ import annotations

from ros2doctor.api.extension import DoctorReport
from ros2doctor.api.report import Report
from ros2doctor.facts.wheels import read_wheels


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

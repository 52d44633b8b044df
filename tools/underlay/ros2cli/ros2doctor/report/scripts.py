# SPDX-License-Identifier: Apache-2.0
"""The interpreters of the installed scripts."""

from __future__ import annotations

from collections import Counter

from ros2doctor.api.extension import DoctorReport
from ros2doctor.api.report import Report
from ros2doctor.facts.scripts import read_scripts


class ScriptsReport(DoctorReport):
    """The report of which interpreter runs how many scripts."""

    def category(self) -> str:
        """Return the name."""
        return 'scripts'

    def report(self) -> Report:
        """Return the section."""
        report = Report('INTERPRETERS OF INSTALLED SCRIPTS')
        counts = Counter(script.interpreter for script in read_scripts())
        for interpreter, count in sorted(counts.items()):
            report.add_to_report(interpreter, f'{count} scripts')
        return report

# SPDX-License-Identifier: Apache-2.0
"""The interpreters of the installed scripts."""

from __future__ import annotations

from collections import Counter

from ros2doctor.api.extension import DoctorReport
from ros2doctor.api.report import Report
from ros2doctor.facts.scripts import read_scripts


class ScriptsReport(DoctorReport):
    """Report of the number of scripts per interpreter."""

    def category(self) -> str:
        """Return the category."""
        return 'scripts'

    def report(self) -> Report:
        """Return the section."""
        report = Report('INTERPRETERS OF INSTALLED SCRIPTS')
        counts = Counter(script.interpreter for script in read_scripts())
        for interpreter, count in sorted(counts.items()):
            report.add_to_report(interpreter, f'{count} scripts')
        return report

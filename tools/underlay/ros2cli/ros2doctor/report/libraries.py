# SPDX-License-Identifier: Apache-2.0
"""The library path."""

from __future__ import annotations

from ros2doctor.api.extension import DoctorReport
from ros2doctor.api.report import Report
from ros2doctor.facts.libraries import read_libraries


class LibrariesReport(DoctorReport):
    """Report of the library folders."""

    def category(self) -> str:
        """Return the category."""
        return 'libraries'

    def report(self) -> Report:
        """Return the section."""
        facts = read_libraries()
        report = Report('LIBRARIES')
        report.add_to_report('of the wheels', facts.own)
        for folder in facts.search:
            ros = ['ROS'] if folder.has_ros else []
            contents = ', '.join([*ros, *folder.system_libraries])
            report.add_to_report('searched', f'{folder.path} ({contents})'.replace(' ()', ''))
        return report

# SPDX-License-Identifier: Apache-2.0
"""The machine."""

from __future__ import annotations

import os
import platform
import sys

from ros2doctor.api.extension import DoctorReport
from ros2doctor.api.report import Report


class PlatformReport(DoctorReport):
    """Report of the machine and its Python."""

    def category(self) -> str:
        """Return the category."""
        return 'platform'

    def report(self) -> Report:
        """Return the section."""
        report = Report('PLATFORM INFORMATION')
        report.add_to_report('system', platform.system())
        report.add_to_report('platform info', platform.platform())
        report.add_to_report('release', platform.release())
        report.add_to_report('processor', f'{platform.machine()}, {os.cpu_count()} cores')
        report.add_to_report('c library', ' '.join(platform.libc_ver()))
        report.add_to_report('python', f'{platform.python_version()}, {sys.executable}')
        return report

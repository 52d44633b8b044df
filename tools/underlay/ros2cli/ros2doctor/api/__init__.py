# SPDX-License-Identifier: Apache-2.0
"""
Checks and reports.

A package adds its own through the entry point groups `ros2doctor.checks` and `ros2doctor.report`,
with a class derived from DoctorCheck or DoctorReport.
"""

from ros2doctor.api.examining import generate_reports, run_checks
from ros2doctor.api.extension import DoctorCheck, DoctorReport, Finding, Report, Result, Severity

__all__ = [
    'DoctorCheck',
    'DoctorReport',
    'Finding',
    'Report',
    'Result',
    'Severity',
    'generate_reports',
    'run_checks',
]

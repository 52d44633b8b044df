# SPDX-License-Identifier: Apache-2.0
"""The variables that concern ROS."""

from __future__ import annotations

from ros2doctor.api.extension import DoctorReport
from ros2doctor.api.report import Report
from ros2doctor.facts.environment import PATH_VARIABLES, read_environment

PREFIXES = ('ROS_', 'RMW_', 'RCUTILS_', 'FASTRTPS_', 'FASTDDS_', 'AMENT_', 'COLCON_', '_ROS_')
NAMES = (*PATH_VARIABLES, 'LD_LIBRARY_PATH', 'PATH', 'VIRTUAL_ENV', 'CONDA_PREFIX', 'SHELL')


class EnvironmentReport(DoctorReport):
    """Report of the shell's variables and programs."""

    def category(self) -> str:
        """Return the category."""
        return 'environment'

    def report(self) -> Report:
        """Return the section."""
        facts = read_environment()
        report = Report('ROS 2 INFORMATION')
        report.add_to_report('distribution name', facts.variables.get('ROS_DISTRO', ''))
        report.add_to_report('rclpy', facts.rclpy)
        report.add_to_report('colcon', facts.colcon.path if facts.colcon else None)
        for name, value in sorted(facts.variables.items()):
            if name in NAMES or name.startswith(PREFIXES):
                report.add_to_report(name, value)
        return report

# SPDX-License-Identifier: Apache-2.0
"""OpenGL."""

from __future__ import annotations

from ros2doctor.api.extension import DoctorReport
from ros2doctor.api.report import Report
from ros2doctor.facts.graphics import read_graphics

VARIABLES = ('DISPLAY', 'WAYLAND_DISPLAY', 'MUJOCO_GL', 'LIBGL_ALWAYS_SOFTWARE')


class GraphicsReport(DoctorReport):
    """Report of the rendering of a simulator."""

    def category(self) -> str:
        """Return the category."""
        return 'graphics'

    def report(self) -> Report:
        """Return the section."""
        facts = read_graphics()
        report = Report('GRAPHICS')
        for name, file in facts.libraries.items():
            report.add_to_report(f'lib{name}', file or 'missing')
        report.add_to_report('drivers of libEGL', ', '.join(facts.drivers))
        for device, is_accessible in facts.devices.items():
            report.add_to_report(device, 'usable' if is_accessible else 'not for this user')
        for name in VARIABLES:
            report.add_to_report(name, facts.variables.get(name, ''))
        return report

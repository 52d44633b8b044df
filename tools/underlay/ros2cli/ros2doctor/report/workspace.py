# SPDX-License-Identifier: Apache-2.0
"""The packages of the relevant workspaces."""

from __future__ import annotations

from ros2doctor.api.extension import DoctorReport
from ros2doctor.api.report import Report
from ros2doctor.facts.workspace import PackageState, read_workspaces


class WorkspaceReport(DoctorReport):
    """Report of built and sourced packages."""

    def category(self) -> str:
        """Return the category."""
        return 'workspace'

    def report(self) -> Report:
        """Return the section."""
        report = Report('WORKSPACES')
        for workspace in read_workspaces():
            report.add_to_report('folder', workspace.folder)
            for package in workspace.packages:
                report.add_to_report(package.name, _state(package))
        return report


def _state(package: PackageState) -> str:
    words = [
        'built' if package.is_built else 'not built',
        'known to this terminal' if package.is_known else 'not known to this terminal',
    ]
    if package.changed:
        words.append(f'{len(package.changed)} files changed since')
    return ', '.join(words)

# SPDX-License-Identifier: Apache-2.0
"""How findings and reports are printed."""

from __future__ import annotations

import warnings

from ros2doctor.api.finding import Finding
from ros2doctor.api.report import Report

INDENT = '    '


def doctor_warn(msg: str) -> None:
    """Say on stderr that the doctor itself cannot do something, without the line of its code."""
    warnings.warn_explicit(msg, UserWarning, 'ros2doctor', 1)


def doctor_error(msg: str) -> None:
    """Say on stderr that the doctor itself has failed at something."""
    doctor_warn(f'ERROR: {msg}')


def finding_text(category: str, finding: Finding) -> str:
    """Return a finding as lines: what is wrong, why it matters, what mends it."""
    lines = [f'{finding.severity.value} ({category}): {finding.what}']
    if finding.why:
        lines.append(f'{INDENT}why it matters: {finding.why}')
    if finding.mend:
        mend = finding.mend.replace('\n', f'\n{INDENT}')
        lines.append(f'{INDENT}to mend it: {mend}')
    return '\n'.join(lines)


def format_print(report: Report) -> None:
    """Print a section with its items below each other."""
    print(f'\n   {report.name}')
    if not report.items:
        print('none')
    width = max((len(name) for name, _ in report.items), default=0)
    for name, info in report.items:
        print(f'{name:<{width}} : {info}')

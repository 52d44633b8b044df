# SPDX-License-Identifier: Apache-2.0
"""How findings and reports are printed."""

from __future__ import annotations

import warnings

from ros2doctor.api.finding import Finding
from ros2doctor.api.report import Report

INDENT = '    '


def doctor_warn(msg: str) -> None:
    """
    Warn on stderr that the doctor itself cannot do something.

    Parameters
    ----------
    msg
        The warning, which is printed without a source line of the doctor.

    """
    warnings.warn_explicit(msg, UserWarning, 'ros2doctor', 1)


def doctor_error(msg: str) -> None:
    """
    Print on stderr that the doctor itself has failed at something.

    Parameters
    ----------
    msg
        What has failed, printed as a warning that begins with `ERROR:`.

    """
    doctor_warn(f'ERROR: {msg}')


def finding_text(category: str, finding: Finding) -> str:
    """
    Format a finding as lines of text: what is wrong, why it matters, how to fix it.

    Parameters
    ----------
    category
        The category of the check that found it.
    finding
        The finding; lines are left out where it does not say why, or how to fix it.

    Returns
    -------
    str
        The lines, indented after the first one, without a newline at the end.

    """
    lines = [f'{finding.severity.value} ({category}): {finding.what}']
    if finding.why:
        lines.append(f'{INDENT}why it matters: {finding.why}')
    if finding.mend:
        mend = finding.mend.replace('\n', f'\n{INDENT}')
        lines.append(f'{INDENT}to mend it: {mend}')
    return '\n'.join(lines)


def format_print(report: Report) -> None:
    """
    Print a report with its items below each other, in two aligned columns.

    Parameters
    ----------
    report
        The section; `none` stands below the title of one without items.

    """
    print(f'\n   {report.name}')
    if not report.items:
        print('none')
    width = max((len(name) for name, _ in report.items), default=0)
    for name, info in report.items:
        print(f'{name:<{width}} : {info}')

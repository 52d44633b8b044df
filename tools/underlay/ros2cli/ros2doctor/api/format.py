# SPDX-License-Identifier: Apache-2.0
"""Formatting of findings and reports."""

from __future__ import annotations

import warnings

from ros2doctor.api.extension import Finding, Report

INDENT = '    '


def doctor_warn(msg: str) -> None:
    """
    Print a warning about the doctor itself on stderr.

    Parameters
    ----------
    msg
        The warning, which is printed without a source line.

    """
    warnings.warn_explicit(msg, UserWarning, 'ros2doctor', 1)


def doctor_error(msg: str) -> None:
    """
    Print an error of the doctor itself on stderr.

    Parameters
    ----------
    msg
        The error, printed as a warning that begins with `ERROR:`.

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
        The finding; lines without a reason or fix are left out.

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
        lines.append(f'{INDENT}to fix it: {mend}')
    return '\n'.join(lines)


def format_print(report: Report) -> None:
    """
    Print a report with its items below each other, in two aligned columns.

    Parameters
    ----------
    report
        The section; `none` is printed below the title if it has no items.

    """
    print(f'\n   {report.name}')
    if not report.items:
        print('none')
    width = max((len(name) for name, _ in report.items), default=0)
    for name, info in report.items:
        print(f'{name:<{width}} : {info}')

# SPDX-License-Identifier: Apache-2.0
"""The checks and reports in the order of their output, and their run."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from typing import Any

from ros2cli.entry import entries_of_group, Entry
from ros2doctor.api.extension import Finding, Report, Result, Severity
from ros2doctor.api.format import doctor_warn, finding_text, format_print

CHECK_GROUP = 'ros2doctor.checks'
REPORT_GROUP = 'ros2doctor.report'
WORKSPACE = 'workspace'

CHECKS = {
    'environment': Entry('ros2doctor.check.environment:EnvironmentCheck', ''),
    'wheels': Entry('ros2doctor.check.wheels:WheelsCheck', ''),
    'libraries': Entry('ros2doctor.check.libraries:LibrariesCheck', ''),
    'scripts': Entry('ros2doctor.check.scripts:ScriptsCheck', ''),
    WORKSPACE: Entry('ros2doctor.check.workspace:WorkspaceCheck', ''),
    'network': Entry('ros2doctor.check.network:NetworkCheck', ''),
    'discovery servers': Entry('ros2doctor.check.servers:ServersCheck', ''),
    'graphics': Entry('ros2doctor.check.graphics:GraphicsCheck', ''),
    'rclpy': Entry('ros2doctor.check.graph:ClientLibraryCheck', ''),
    'qos': Entry('ros2doctor.check.qos:QosCheck', ''),
    'nodes': Entry('ros2doctor.check.nodes:NodesCheck', ''),
    'neighbours': Entry('ros2doctor.check.nodes:NeighboursCheck', ''),
    'clock': Entry('ros2doctor.check.clock:ClockCheck', ''),
    'frames': Entry('ros2doctor.check.frames:FramesCheck', ''),
    'diagnostics': Entry('ros2doctor.check.nodes:DiagnosticsCheck', ''),
}
REPORTS = {
    'platform': Entry('ros2doctor.check.environment:PlatformReport', ''),
    'environment': Entry('ros2doctor.check.environment:EnvironmentReport', ''),
    'wheels': Entry('ros2doctor.check.wheels:WheelsReport', ''),
    'libraries': Entry('ros2doctor.check.libraries:LibrariesReport', ''),
    'scripts': Entry('ros2doctor.check.scripts:ScriptsReport', ''),
    WORKSPACE: Entry('ros2doctor.check.workspace:WorkspaceReport', ''),
    'network': Entry('ros2doctor.check.network:NetworkReport', ''),
    'discovery servers': Entry('ros2doctor.check.servers:ServersReport', ''),
    'graphics': Entry('ros2doctor.check.graphics:GraphicsReport', ''),
    'nodes': Entry('ros2doctor.check.nodes:NodesReport', ''),
    'qos': Entry('ros2doctor.check.qos:QosReport', ''),
    'frames': Entry('ros2doctor.check.frames:FramesReport', ''),
}


def examine(*, include_warnings: bool, exclude_packages: bool) -> set[str]:
    """
    Run the checks and print their findings and a summary.

    Parameters
    ----------
    include_warnings
        Whether a check with only warnings counts as failed, too.
    exclude_packages
        Whether the check of the workspace's packages is left out.

    Returns
    -------
    set of str
        The categories of the checks that failed.

    """
    failed, failures, total = run_checks(
        include_warnings=include_warnings, exclude_packages=exclude_packages
    )
    if failures:
        print(f'\n{failures}/{total} check(s) failed')
        print('\nFailed modules:', *sorted(failed), end='\n\n')
    else:
        print(f'\nAll {total} checks passed', end='\n\n')
    return failed


def run_checks(
    *, include_warnings: bool = False, exclude_packages: bool = False
) -> tuple[set[str], int, int]:
    """
    Run the checks and print the findings of each as soon as it is done.

    A check that raises an exception counts as failed; the others still run.

    Parameters
    ----------
    include_warnings, exclude_packages
        As for `examine`.

    Returns
    -------
    tuple
        The categories of the failed checks, the number of failed checks, and their total number.

    """
    failed: set[str] = set()
    failures = total = 0
    for check in _load(CHECKS, CHECK_GROUP, exclude_packages):
        category, result = check.category(), _result(check)
        _print_findings(category, result)
        total += 1
        if result.error or (include_warnings and result.warning):
            failed.add(category)
            failures += 1
    return failed, failures, total


def print_reports(
    *, categories: Collection[str] | None = None, exclude_packages: bool = False
) -> None:
    """
    Print the reports of some categories, or all of them and then the findings of the checks.

    Parameters
    ----------
    categories
        The categories to print, without running the checks; None for everything.
    exclude_packages
        Whether the report and the check of the workspace's packages are left out.

    """
    for report in generate_reports(categories=categories, exclude_packages=exclude_packages):
        format_print(report)
    if categories is None:
        print('\n   FINDINGS', flush=True)
        examine(include_warnings=False, exclude_packages=exclude_packages)


def generate_reports(
    *, categories: Collection[str] | None = None, exclude_packages: bool = False
) -> Iterator[Report]:
    """
    Generate the reports of some categories, or all.

    Parameters
    ----------
    categories
        The categories to report; None for all.
    exclude_packages
        Whether the report of the workspace's packages is left out.

    Yields
    ------
    Report
        A section; if its report raises an exception, a section that names the exception.

    """
    for report in _load(REPORTS, REPORT_GROUP, exclude_packages):
        if categories is None or report.category() in categories:
            yield _section(report)


def _load(entries: Mapping[str, Entry], group: str, exclude_packages: bool) -> Iterator[Any]:
    """Yield an instance of each class of a table and a group; warn of those that fail to load."""
    for name, entry in {**entries_of_group(group), **entries}.items():
        if exclude_packages and name == WORKSPACE:
            continue
        try:
            yield entry.create()
        except (ImportError, AttributeError) as error:
            doctor_warn(f"'{name}' of {group} cannot be loaded: {error}")


def _result(check: Any) -> Result:
    """Run a check and return its findings; catch its exceptions, so that the others run."""
    try:
        result: Result = check.check()
    except Exception as error:
        what = f'the check itself failed: {_text(error)}'
        return Result([Finding(Severity.ERROR, what, 'its subject was not checked')])
    return result


def _section(report: Any) -> Report:
    try:
        section: Report = report.report()
    except Exception as error:
        section = Report(report.category().upper())
        section.add_to_report('not available', _text(error))
    return section


def _text(error: Exception) -> str:
    return f'{type(error).__name__}: {error}'


def _print_findings(category: str, result: Result) -> None:
    for finding in getattr(result, 'findings', ()):
        print('\n' + finding_text(category, finding), flush=True)

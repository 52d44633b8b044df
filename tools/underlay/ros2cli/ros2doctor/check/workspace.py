# SPDX-License-Identifier: Apache-2.0
"""Check that the workspace is built, sourced, and as new as its sources."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path
import shlex

from ros2doctor.api.extension import DoctorCheck
from ros2doctor.api.finding import Finding, Result, Severity
from ros2doctor.facts.workspace import PackageState, read_workspaces, Workspace
from ros_environment.advice import build_command, listing, source_command


class WorkspaceCheck(DoctorCheck):
    """Check of the relevant workspaces."""

    def category(self) -> str:
        """Return the category."""
        return 'workspace'

    def check(self) -> Result:
        """Check for workspaces and packages that have to be built or sourced."""
        return Result(workspace_findings(read_workspaces()))


def workspace_findings(facts: Iterable[Workspace]) -> Iterator[Finding]:
    """
    Report workspaces and packages that have to be built or sourced.

    Parameters
    ----------
    facts
        The workspaces; those that neither are sourced nor contain the current folder are skipped.

    Yields
    ------
    Finding
        An error for a workspace that is not built or not sourced at all, else a warning for each
        package that is not built, not sourced, or older than its sources.

    """
    for workspace in filter(_is_used, facts):
        built = [package for package in workspace.packages if package.is_built]
        if not built:
            yield _not_built(workspace.folder)
            continue
        if not any(package.is_known for package in built):
            yield _not_sourced(workspace.folder)
            continue
        for package in workspace.packages:
            yield from _package_findings(workspace.folder, package)


def _is_used(workspace: Workspace) -> bool:
    """Whether a workspace contains the current folder or is sourced."""
    return workspace.is_current or any(package.is_known for package in workspace.packages)


def _package_findings(folder: Path, package: PackageState) -> Iterator[Finding]:
    if not package.is_built:
        yield Finding(
            Severity.WARNING,
            f"the package '{package.name}' in '{package.folder}' is not built",
            '`ros2 run` and `ros2 launch` do not find it',
            build_command(folder, package.name),
        )
    elif not package.is_known:
        yield Finding(
            Severity.WARNING,
            f"the package '{package.name}' was built after this terminal was set up",
            '`ros2 run` and `ros2 launch` do not find it here',
            source_command(folder),
        )
    elif package.changed:
        yield Finding(
            Severity.WARNING,
            f"'{package.name}' is older than its sources: {listing(list(package.changed))}",
            'what runs is the state before these changes',
            build_command(folder, package.name),
        )


def _not_built(folder: Path) -> Finding:
    return Finding(
        Severity.ERROR,
        f"the workspace '{folder}' is not built",
        'none of its packages can be run or launched',
        f'cd {shlex.quote(str(folder))} && colcon build && source install/setup.bash',
    )


def _not_sourced(folder: Path) -> Finding:
    return Finding(
        Severity.ERROR,
        f"the workspace '{folder}' is built, but not sourced in this terminal",
        '`ros2 run` and `ros2 launch` do not find its packages',
        source_command(folder),
    )

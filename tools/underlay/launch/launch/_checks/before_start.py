# SPDX-License-Identifier: Apache-2.0
"""
Checks that run after the first visit and before the first process starts.

They are added while the description is visited. The last one names installed files that are older
than their source.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
import os
from typing import Any, TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    import logging

    from launch.launch_context import LaunchContext

_SHARE = '/share/'
SWITCH = 'LAUNCH_PREFLIGHT'

_Check = TypeVar('_Check')


class BeforeStart:
    """Pre-start checks of a launch; if one raises an error, no process is started."""

    def __init__(self) -> None:
        """Create an empty set of checks; LAUNCH_PREFLIGHT=0 disables the check for programs."""
        self.resolves_programs = os.environ.get(SWITCH, '1') != '0'
        self.checks: list[Callable[[LaunchContext], None]] = []
        self.hints: list[Callable[[LaunchContext], str]] = []
        self.files: dict[str, None] = {}

    def check_of_type(self, kind: Callable[[], _Check]) -> _Check:
        """
        Get the check of a class; create it on first use.

        Parameters
        ----------
        kind
            The class; its instances are called with the context and raise an error on failure.

        """
        for check in self.checks:
            if isinstance(check, kind):  # type: ignore[arg-type]
                return check  # type: ignore[return-value]
        added: Any = kind()
        self.checks.append(added)
        return added  # type: ignore[no-any-return]

    def run(self, context: LaunchContext, logger: logging.Logger) -> None:
        """
        Run the added checks, then warn about installed files that are older than their source.

        Parameters
        ----------
        context
            The context of the launch, whose first description has been visited.
        logger
            The logger for the warnings.

        Raises
        ------
        Exception
            The error raised by a check.

        """
        for check in self.checks:
            check(context)
        installed = [path for path in self.files if _SHARE in path]
        if installed:
            warn_of_stale_files(installed, logger)

    def explain_failure(self, context: LaunchContext) -> list[str]:
        """
        Collect hints on why a visit may have failed.

        Parameters
        ----------
        context
            The context of the launch, passed to each hint.

        Returns
        -------
        list of str
            Lines for the log; empty hints are omitted.

        """
        return [text for text in (hint(context) for hint in self.hints) if text]


def warn_of_stale_files(paths: Iterable[str], logger: logging.Logger) -> None:
    """
    Warn about installed files whose source is newer and differs.

    Parameters
    ----------
    paths
        The paths of the installed files.
    logger
        The logger for the warnings.

    """
    from ros_environment.source_tree import StaleFiles

    files = StaleFiles()
    for path in paths:
        source = files.newer_source(path)
        if source:
            logger.warning(
                "'%s' is newer than the installed '%s', which is used; run colcon build",
                source,
                path,
            )


def note_files_of_command(context: LaunchContext, command: str) -> None:
    """
    Record the installed files that a command line names, such as a model for xacro.

    Parameters
    ----------
    context
        The context that records them; nothing is recorded once the checks have run.
    command
        The command line, which is split as a shell does.

    """
    if context.run.before_start is None or _SHARE not in command:
        return
    import shlex

    for word in shlex.split(command):
        if _SHARE in word and os.path.isfile(word):
            context.run.note_file(word)

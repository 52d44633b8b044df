# SPDX-License-Identifier: Apache-2.0
"""Warnings about files that were modified in the workspace after they had been installed."""

from __future__ import annotations

from collections.abc import Iterable
import os
import shlex
from typing import TYPE_CHECKING

from launch._before_start import note_file

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext

_SHARE = '/share/'


def warn_of_stale_files(paths: Iterable[str]) -> None:
    """
    Warn about installed files whose source is newer and differs.

    Without the package `ros_environment` nothing is checked.

    Parameters
    ----------
    paths
        The paths of the installed files.

    """
    try:
        from ros_environment.stale import StaleFiles
    except ImportError:
        return
    from launch.logging import get_logger

    files = StaleFiles()
    for path in paths:
        source = files.newer_source(path)
        if source:
            get_logger('launch').warning(
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
    if context._before_start is None or _SHARE not in command:
        return
    for word in shlex.split(command):
        if _SHARE in word and os.path.isfile(word):
            note_file(context, word)

# SPDX-License-Identifier: Apache-2.0
"""Track the launch file that is being read."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from launch._before_start import note_file
from launch.launch_description_entity import LaunchDescriptionEntity

if TYPE_CHECKING:
    from launch._include_stack import OpenFile
    from launch.launch_context import LaunchContext

_PATH = 'current_launch_file_path'
_FOLDER = 'current_launch_file_directory'


def enter_launch_file(context: LaunchContext, file: OpenFile) -> LeaveLaunchFile:
    """
    Make a launch file the current one.

    Parameters
    ----------
    context
        The launch context; its local variables are set to the path and the directory of the file.
    file
        The entry of the include stack.

    Returns
    -------
    LeaveLaunchFile
        The entity that leaves the file; visit it after the contents of the file.

    """
    known = context.get_locals_as_dict()
    before = {name: known[name] for name in (_PATH, _FOLDER) if name in known}
    leave = LeaveLaunchFile(before, context._open_files)
    context.extend_locals({_PATH: file.path, _FOLDER: os.path.dirname(file.path)})
    context._open_files = (*context._open_files, file)
    note_file(context, file.path)
    return leave


class LeaveLaunchFile(LaunchDescriptionEntity):
    """
    Entity that makes the including file the current one again.

    In ROS 2 Jazzy, ThisLaunchFile and ThisLaunchFileDir continue to refer to the included file.
    They do the same here, unless the context scopes the location.

    Parameters
    ----------
    before
        The local variables about the including file; empty if there is none.
    open_files
        The include stack without the included file.

    """

    def __init__(self, before: dict[str, str], open_files: tuple[OpenFile, ...]) -> None:
        self._before = before
        self._open_files = open_files

    def visit(self, context: LaunchContext) -> None:
        """
        Restore the include stack, and the location of the launch file if the context scopes it.

        Parameters
        ----------
        context
            The launch context.

        """
        context._open_files = self._open_files
        if self._before and context._scopes_location:
            context.extend_locals(self._before)

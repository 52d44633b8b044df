# SPDX-License-Identifier: Apache-2.0
"""Keep track of which launch file is being read."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from launch.launch_description_entity import LaunchDescriptionEntity

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext

_PATH = 'current_launch_file_path'
_FOLDER = 'current_launch_file_directory'


def enter_launch_file(context: LaunchContext, path: str) -> dict[str, str]:
    """Make a file the one that is being read; return what leaving it has to restore."""
    known = context.get_locals_as_dict()
    before = {name: known[name] for name in (_PATH, _FOLDER) if name in known}
    context.extend_locals({_PATH: path, _FOLDER: os.path.dirname(path)})
    return before


class LeaveLaunchFile(LaunchDescriptionEntity):
    """Makes the including file the one that is being read again."""

    def __init__(self, before: dict[str, str]) -> None:
        """Create the entity from what was known before."""
        self._before = before

    def visit(self, context: LaunchContext) -> None:
        """Restore it."""
        if self._before:
            context.extend_locals(self._before)

# SPDX-License-Identifier: Apache-2.0
"""The folder of the launch file that is being read."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.substitutions._path_operator import PathOperator
from launch.substitutions.substitution_failure import SubstitutionFailure

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class ThisLaunchFileDir(PathOperator):
    """Stands for the folder of the launch file that is being read."""

    def describe(self) -> str:
        """Return a short description for people."""
        return 'ThisLaunchFileDir()'

    def perform(self, context: LaunchContext) -> str:
        """Return the folder; a failure says that no file is being read."""
        folder = context.get_locals_as_dict().get('current_launch_file_directory')
        if folder is None:
            raise SubstitutionFailure(
                'ThisLaunchFileDir cannot be used in a script: no launch file is being read'
            )
        return str(folder)

# SPDX-License-Identifier: Apache-2.0
"""The folder of the log files of this launch."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.substitutions._path_operator import PathOperator

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class LaunchLogDir(PathOperator):
    """Stands for the folder of the log files of this launch."""

    def describe(self) -> str:
        """Return a short description for people."""
        return 'LaunchLogDir()'

    def perform(self, context: LaunchContext) -> str:
        """
        Return the folder of the log files, which is made if it is not there.

        Parameters
        ----------
        context
            The state of the launch, which is not used.

        """
        from launch.logging import launch_config

        return str(launch_config.log_dir)

# SPDX-License-Identifier: Apache-2.0
"""The files of this launch: the launch file that is being read, its folder, and the log folder."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch._include_stack import launch_file_location
from launch.substitutions.path_join_substitution import PathOperator

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class ThisLaunchFile(PathOperator):
    """Stands for the path of the launch file that is being read."""

    def describe(self) -> str:
        """Return a short human-readable description."""
        return 'ThisLaunchFile()'

    def perform(self, context: LaunchContext) -> str:
        """
        Return the path of the launch file that is being read.

        Parameters
        ----------
        context
            The launch context, whose local variables are read.

        Raises
        ------
        SubstitutionFailure
            No launch file is being read.

        """
        return launch_file_location(context, 'current_launch_file_path', 'ThisLaunchFile')


class ThisLaunchFileDir(PathOperator):
    """Stands for the folder of the launch file that is being read."""

    def describe(self) -> str:
        """Return a short human-readable description."""
        return 'ThisLaunchFileDir()'

    def perform(self, context: LaunchContext) -> str:
        """
        Return the directory of the launch file that is being read.

        Parameters
        ----------
        context
            The launch context, whose local variables are read.

        Raises
        ------
        SubstitutionFailure
            No launch file is being read.

        """
        return launch_file_location(context, 'current_launch_file_directory', 'ThisLaunchFileDir')


class LaunchLogDir(PathOperator):
    """Stands for the folder of the log files of this launch."""

    def describe(self) -> str:
        """Return a short human-readable description."""
        return 'LaunchLogDir()'

    def perform(self, context: LaunchContext) -> str:
        """
        Return the log directory, which is created if it does not exist.

        Parameters
        ----------
        context
            The launch context, which is not used.

        """
        from launch.logging import launch_config

        return str(launch_config.log_dir)

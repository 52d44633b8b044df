# SPDX-License-Identifier: Apache-2.0
"""The log directory of this launch."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.substitutions.path_join_substitution import PathOperator

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


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

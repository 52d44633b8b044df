# SPDX-License-Identifier: Apache-2.0
"""A negated comparison."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.substitutions.equals_substitution import EqualsSubstitution

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class NotEqualsSubstitution(EqualsSubstitution):
    """Stands for `true` if two values differ."""

    def perform(self, context: LaunchContext) -> str:
        """
        Compare the values; return `true` if they differ, else `false`.

        Parameters
        ----------
        context
            The launch context, in which the values are performed.

        """
        return 'false' if self._equal(context) else 'true'

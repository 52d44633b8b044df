# SPDX-License-Identifier: Apache-2.0
"""A condition that is fulfilled by a false expression."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.conditions.if_condition import IfCondition

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class UnlessCondition(IfCondition):
    """Fulfilled if an expression is false or 0, not if it is true or 1; else an error."""

    def _predicate_func(self, context: LaunchContext) -> bool:
        return not super()._predicate_func(context)

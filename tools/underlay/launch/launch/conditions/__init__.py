# SPDX-License-Identifier: Apache-2.0
"""The conditions under which an action is executed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .._lazy import lazy_exports

if TYPE_CHECKING:
    from .evaluate_condition_expression_impl import evaluate_condition_expression
    from .if_condition import IfCondition
    from .launch_configuration_equals import LaunchConfigurationEquals
    from .launch_configuration_not_equals import LaunchConfigurationNotEquals
    from .unless_condition import UnlessCondition

__all__ = [
    'IfCondition',
    'LaunchConfigurationEquals',
    'LaunchConfigurationNotEquals',
    'UnlessCondition',
    'evaluate_condition_expression',
]

_ELSEWHERE = {
    'evaluate_condition_expression': 'evaluate_condition_expression_impl',
}

__getattr__, __dir__ = lazy_exports(__name__, __all__, _ELSEWHERE)

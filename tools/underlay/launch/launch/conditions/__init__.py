# SPDX-License-Identifier: Apache-2.0
"""The conditions under which an action is executed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch._lazy import lazy_exports

if TYPE_CHECKING:
    from launch.conditions.evaluate_condition_expression_impl import evaluate_condition_expression
    from launch.conditions.if_condition import IfCondition
    from launch.conditions.launch_configuration_equals import LaunchConfigurationEquals
    from launch.conditions.launch_configuration_not_equals import LaunchConfigurationNotEquals
    from launch.conditions.unless_condition import UnlessCondition

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

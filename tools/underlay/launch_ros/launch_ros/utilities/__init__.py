# SPDX-License-Identifier: Apache-2.0
"""Utilities for the ROS actions of launch."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros_environment.lazy import also_found_at, lazy_exports

if TYPE_CHECKING:
    from launch_ros.utilities.node_names import (
        add_node_name,
        get_node_name_count,
        is_namespace_absolute,
        is_root_namespace,
        make_namespace_absolute,
        prefix_namespace,
    )
    from launch_ros.utilities.parameter_list import to_parameters_list
    from launch_ros.utilities.parameters_and_remappings import (
        evaluate_parameters,
        normalize_parameters,
        normalize_remap_rule,
        normalize_remap_rules,
    )

__all__ = [
    'add_node_name',
    'evaluate_parameters',
    'get_node_name_count',
    'is_namespace_absolute',
    'is_root_namespace',
    'make_namespace_absolute',
    'normalize_parameters',
    'normalize_remap_rule',
    'normalize_remap_rules',
    'prefix_namespace',
    'to_parameters_list',
]

# ROS 2 Jazzy has a module for each of them; other packages import from those, too.
also_found_at(__name__, 'namespace_utils', 'track_node_names')

_ELSEWHERE = {
    'add_node_name': 'node_names',
    'evaluate_parameters': 'parameters_and_remappings',
    'get_node_name_count': 'node_names',
    'is_namespace_absolute': 'node_names',
    'is_root_namespace': 'node_names',
    'make_namespace_absolute': 'node_names',
    'normalize_parameters': 'parameters_and_remappings',
    'normalize_remap_rule': 'parameters_and_remappings',
    'normalize_remap_rules': 'parameters_and_remappings',
    'prefix_namespace': 'node_names',
    'to_parameters_list': 'parameter_list',
}

__getattr__, __dir__ = lazy_exports(__name__, __all__, _ELSEWHERE)

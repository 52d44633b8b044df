# SPDX-License-Identifier: Apache-2.0
"""Utilities for the ROS actions of launch."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros_environment.lazy import lazy_exports

if TYPE_CHECKING:
    from launch_ros.utilities.namespace_utils import (
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
    from launch_ros.utilities.track_node_names import add_node_name, get_node_name_count

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

_ELSEWHERE = {
    'add_node_name': 'track_node_names',
    'evaluate_parameters': 'parameters_and_remappings',
    'get_node_name_count': 'track_node_names',
    'is_namespace_absolute': 'namespace_utils',
    'is_root_namespace': 'namespace_utils',
    'make_namespace_absolute': 'namespace_utils',
    'normalize_parameters': 'parameters_and_remappings',
    'normalize_remap_rule': 'parameters_and_remappings',
    'normalize_remap_rules': 'parameters_and_remappings',
    'prefix_namespace': 'namespace_utils',
    'to_parameters_list': 'parameter_list',
}

__getattr__, __dir__ = lazy_exports(__name__, __all__, _ELSEWHERE)

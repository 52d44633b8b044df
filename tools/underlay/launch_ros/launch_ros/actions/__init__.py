# SPDX-License-Identifier: Apache-2.0
"""Launch actions for ROS nodes, parameters, namespaces and lifecycle transitions."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros_environment.lazy import also_found_at, lazy_exports

if TYPE_CHECKING:
    from launch_ros.actions.composable_nodes import ComposableNodeContainer, LoadComposableNodes
    from launch_ros.actions.following_nodes import (
        PushROSNamespace,
        PushRosNamespace,
        SetParameter,
        SetParametersFromFile,
        SetRemap,
    )
    from launch_ros.actions.lifecycle_node import LifecycleNode
    from launch_ros.actions.lifecycle_transition import LifecycleTransition
    from launch_ros.actions.node import Node
    from launch_ros.actions.ros_time import ROSTimer, RosTimer, SetUseSimTime
    from launch_ros.actions.set_ros_log_dir import SetROSLogDir

__all__ = [
    'ComposableNodeContainer',
    'LifecycleNode',
    'LifecycleTransition',
    'LoadComposableNodes',
    'Node',
    'PushROSNamespace',
    'PushRosNamespace',
    'ROSTimer',
    'RosTimer',
    'SetParameter',
    'SetParametersFromFile',
    'SetROSLogDir',
    'SetRemap',
    'SetUseSimTime',
]

# ROS 2 Jazzy has a module for each of them; launch files import from those, too.
also_found_at(
    __name__,
    'composable_node_container',
    'load_composable_nodes',
    'push_ros_namespace',
    'ros_timer',
    'set_parameter',
    'set_parameters_from_file',
    'set_remap',
    'set_use_sim_time',
)

_ELSEWHERE = {
    'ComposableNodeContainer': 'composable_nodes',
    'LoadComposableNodes': 'composable_nodes',
    'PushROSNamespace': 'following_nodes',
    'PushRosNamespace': 'following_nodes',
    'ROSTimer': 'ros_time',
    'RosTimer': 'ros_time',
    'SetParameter': 'following_nodes',
    'SetParametersFromFile': 'following_nodes',
    'SetRemap': 'following_nodes',
    'SetUseSimTime': 'ros_time',
}

__getattr__, __dir__ = lazy_exports(__name__, __all__, _ELSEWHERE)

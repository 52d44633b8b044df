# SPDX-License-Identifier: Apache-2.0
"""Launch actions for ROS nodes, parameters, namespaces and lifecycle transitions."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros_environment.lazy import also_found_at, lazy_exports

if TYPE_CHECKING:
    from launch_ros.actions.composable_nodes import ComposableNodeContainer, LoadComposableNodes
    from launch_ros.actions.lifecycle_node import LifecycleNode
    from launch_ros.actions.lifecycle_transition import LifecycleTransition
    from launch_ros.actions.node import Node
    from launch_ros.actions.push_ros_namespace import PushROSNamespace, PushRosNamespace
    from launch_ros.actions.ros_timer import ROSTimer
    from launch_ros.actions.set_parameter import SetParameter, SetParametersFromFile
    from launch_ros.actions.set_remap import SetRemap
    from launch_ros.actions.set_ros_log_dir import SetROSLogDir
    from launch_ros.actions.set_use_sim_time import SetUseSimTime

__all__ = [
    'ComposableNodeContainer',
    'LifecycleNode',
    'LifecycleTransition',
    'LoadComposableNodes',
    'Node',
    'PushROSNamespace',
    'PushRosNamespace',
    'ROSTimer',
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
    'set_parameters_from_file',
)

_ELSEWHERE = {
    'ComposableNodeContainer': 'composable_nodes',
    'LoadComposableNodes': 'composable_nodes',
    'SetParametersFromFile': 'set_parameter',
}

__getattr__, __dir__ = lazy_exports(__name__, __all__, _ELSEWHERE)

# SPDX-License-Identifier: Apache-2.0
"""Launch actions for ROS nodes, parameters, namespaces and lifecycle transitions."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros_environment.lazy import lazy_exports

if TYPE_CHECKING:
    from launch_ros.actions.composable_node_container import ComposableNodeContainer
    from launch_ros.actions.lifecycle_node import LifecycleNode
    from launch_ros.actions.lifecycle_transition import LifecycleTransition
    from launch_ros.actions.load_composable_nodes import LoadComposableNodes
    from launch_ros.actions.node import Node
    from launch_ros.actions.push_ros_namespace import PushROSNamespace, PushRosNamespace
    from launch_ros.actions.ros_timer import ROSTimer
    from launch_ros.actions.set_parameter import SetParameter
    from launch_ros.actions.set_parameters_from_file import SetParametersFromFile
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

__getattr__, __dir__ = lazy_exports(__name__, __all__)

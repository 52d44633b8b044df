# SPDX-License-Identifier: Apache-2.0
"""Frontend tags and substitutions of this package, which launch.frontend imports on demand."""

from __future__ import annotations

ACTIONS = {
    'lifecycle_node': 'launch_ros.actions.lifecycle_node:LifecycleNode',
    'load_composable_node': 'launch_ros.actions.composable_nodes:LoadComposableNodes',
    'node': 'launch_ros.actions.node:Node',
    'node_container': 'launch_ros.actions.composable_nodes:ComposableNodeContainer',
    'push-ros-namespace': 'launch_ros.actions.following_nodes:PushROSNamespace',
    'push_ros_namespace': 'launch_ros.actions.following_nodes:PushROSNamespace',
    'ros_timer': 'launch_ros.actions.ros_time:ROSTimer',
    'set_parameter': 'launch_ros.actions.following_nodes:SetParameter',
    'set_parameters_from_file': 'launch_ros.actions.following_nodes:SetParametersFromFile',
    'set_remap': 'launch_ros.actions.following_nodes:SetRemap',
    'set_ros_log_dir': 'launch_ros.actions.set_ros_log_dir:SetROSLogDir',
    'set_use_sim_time': 'launch_ros.actions.ros_time:SetUseSimTime',
}

SUBSTITUTIONS = {
    'exec-in-pkg': 'launch_ros.substitutions.find_package:ExecutableInPackage',
    'find-pkg-prefix': 'launch_ros.substitutions.find_package:FindPackagePrefix',
    'find-pkg-share': 'launch_ros.substitutions.find_package:FindPackageShare',
    'param': 'launch_ros.substitutions.parameter:Parameter',
}

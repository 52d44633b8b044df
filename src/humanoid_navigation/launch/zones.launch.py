# SPDX-License-Identifier: Apache-2.0
"""Keep the humanoid out of zones, and slow it down in others: masks for Nav2's costmap filters."""

from __future__ import annotations

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import ComposableNodeContainer
from launch_ros.descriptions import ComposableNode, ParameterFile
from launch_ros.substitutions import FindPackageShare
from nav2_common.launch import RewrittenYaml

ARGUMENTS = (
    (
        'params_file',
        PathJoinSubstitution(
            [FindPackageShare('humanoid_navigation'), 'config', 'keepout_params.yaml']
        ),
        'The parameter file with the masks of the zones, and what they mean.',
    ),
    ('namespace', '', 'The namespace of the robot.'),
    ('use_sim_time', 'false', 'Use the time of the topic /clock instead of the system clock.'),
)
SERVERS = {
    f'{zone}_{name}': f'nav2_map_server::{plugin}'
    for zone in ('keepout', 'speed')
    for name, plugin in (
        ('filter_mask_server', 'MapServer'),
        ('costmap_filter_info_server', 'CostmapFilterInfoServer'),
    )
}


def generate_launch_description() -> LaunchDescription:
    """Start the servers of masks with their manager, all in one process."""
    params = ParameterFile(
        RewrittenYaml(
            source_file=LaunchConfiguration('params_file'),
            root_key=LaunchConfiguration('namespace'),
            param_rewrites={},
            convert_types=True,
        ),
        allow_substs=True,
    )
    clock = {'use_sim_time': LaunchConfiguration('use_sim_time')}
    manager = ComposableNode(
        package='nav2_lifecycle_manager',
        plugin='nav2_lifecycle_manager::LifecycleManager',
        name='lifecycle_manager_zones',
        namespace=LaunchConfiguration('namespace'),
        parameters=[clock, {'autostart': True, 'node_names': list(SERVERS)}],
    )
    return LaunchDescription(
        [
            *(
                DeclareLaunchArgument(name, default_value=default, description=description)
                for name, default, description in ARGUMENTS
            ),
            ComposableNodeContainer(
                package='rclcpp_components',
                executable='component_container',
                name='zones_container',
                namespace=LaunchConfiguration('namespace'),
                output='screen',
                composable_node_descriptions=[
                    *(
                        ComposableNode(
                            package='nav2_map_server',
                            plugin=plugin,
                            name=name,
                            namespace=LaunchConfiguration('namespace'),
                            parameters=[params, clock],
                        )
                        for name, plugin in SERVERS.items()
                    ),
                    manager,
                ],
            ),
        ]
    )

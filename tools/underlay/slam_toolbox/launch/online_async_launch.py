# SPDX-License-Identifier: Apache-2.0
"""Map with a laser scanner while a robot moves, processing the newest scan only."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, EmitEvent, LogInfo, RegisterEventHandler
from launch.conditions import IfCondition
from launch.events import matches_action
from launch.substitutions import (
    AndSubstitution,
    LaunchConfiguration,
    NotSubstitution,
    PathJoinSubstitution,
)
from launch_ros.actions import LifecycleNode
from launch_ros.event_handlers import OnStateTransition
from launch_ros.events.lifecycle import ChangeState
from launch_ros.substitutions import FindPackageShare
from lifecycle_msgs.msg import Transition


def generate_launch_description():
    """Run async_slam_toolbox_node, and configure and activate it."""
    autostart = LaunchConfiguration('autostart')
    is_managed = LaunchConfiguration('use_lifecycle_manager')
    is_started_here = IfCondition(AndSubstitution(autostart, NotSubstitution(is_managed)))
    node = LifecycleNode(
        package='slam_toolbox',
        executable='async_slam_toolbox_node',
        name='slam_toolbox',
        namespace=LaunchConfiguration('namespace'),
        output='screen',
        parameters=[
            LaunchConfiguration('slam_params_file'),
            {
                'use_lifecycle_manager': is_managed,
                'use_sim_time': LaunchConfiguration('use_sim_time'),
            },
        ],
        remappings=[
            ('/tf', 'tf'),
            ('/tf_static', 'tf_static'),
            ('/scan', 'scan'),
            ('/map', 'map'),
            ('/map_metadata', 'map_metadata'),
        ],
    )
    configure = EmitEvent(
        event=ChangeState(
            lifecycle_node_matcher=matches_action(node),
            transition_id=Transition.TRANSITION_CONFIGURE,
        ),
        condition=is_started_here,
    )
    activate = RegisterEventHandler(
        OnStateTransition(
            target_lifecycle_node=node,
            start_state='configuring',
            goal_state='inactive',
            entities=[
                LogInfo(msg='slam_toolbox is configured; activating it.'),
                EmitEvent(
                    event=ChangeState(
                        lifecycle_node_matcher=matches_action(node),
                        transition_id=Transition.TRANSITION_ACTIVATE,
                    )
                ),
            ],
        ),
        condition=is_started_here,
    )
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                'autostart',
                default_value='true',
                description='Configure and activate the node. Ignored with use_lifecycle_manager.',
            ),
            DeclareLaunchArgument(
                'use_lifecycle_manager',
                default_value='false',
                description='Leave configuration to a lifecycle manager.',
            ),
            DeclareLaunchArgument(
                'use_sim_time', default_value='true', description='Use simulated time.'
            ),
            DeclareLaunchArgument(
                'slam_params_file',
                default_value=PathJoinSubstitution(
                    [FindPackageShare('slam_toolbox'), 'config', 'mapper_params_online_async.yaml']
                ),
                description='The parameter file.',
            ),
            DeclareLaunchArgument(
                'namespace', default_value='', description='The namespace of the node.'
            ),
            node,
            activate,
            configure,
        ]
    )

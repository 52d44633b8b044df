# SPDX-License-Identifier: Apache-2.0
"""The parameters of the navigator."""

from __future__ import annotations

from dataclasses import dataclass

from nav2_util.parameters import parameter

__all__ = ['UNSUPPORTED', 'BtNavigatorParameters']


@dataclass(frozen=True)
class BtNavigatorParameters:
    """Parameters of the navigator; names and defaults are those of Nav2."""

    navigators: list[str] = parameter(
        ['navigate_to_pose', 'navigate_through_poses'], 'The actions to offer.', read_only=True
    )
    default_nav_to_pose_bt_xml: str = parameter(
        '', 'The tree file of navigate_to_pose; empty: the one that replans and recovers.'
    )
    default_nav_through_poses_bt_xml: str = parameter(
        '', 'The tree file of navigate_through_poses; empty: the one that replans and recovers.'
    )
    plugin_lib_names: list[str] = parameter(
        [], 'Libraries of nodes; no effect, for all nodes are there.', read_only=True
    )
    global_frame: str = parameter('map', 'The frame of goals.', read_only=True)
    robot_base_frame: str = parameter('base_link', "The robot's frame.", read_only=True)
    odom_topic: str = parameter('odom', 'Where odometry comes from.', read_only=True)
    bt_loop_duration: int = parameter(10, 'The period of ticks in ms.', low=1, high=1000)
    default_server_timeout: int = parameter(
        20, 'How long a server may take to accept a goal, in ms; at least 2 s are granted.', low=0
    )
    wait_for_service_timeout: int = parameter(
        1000, 'How long a server may be missing, in ms.', low=0
    )
    transform_tolerance: float = parameter(
        0.1, 'How old transforms may be, in s; the newest one counts here.', low=0.0
    )
    filter_duration: float = parameter(
        0.3, 'Over how long velocities are averaged, in s.', low=0.0, read_only=True
    )
    goal_blackboard_id: str = parameter(
        'goal', 'The entry of the blackboard for the goal.', read_only=True
    )
    goals_blackboard_id: str = parameter(
        'goals', 'The entry of the blackboard for the goals.', read_only=True
    )
    path_blackboard_id: str = parameter(
        'path', 'The entry of the blackboard for the path.', read_only=True
    )
    error_code_names: list[str] = parameter(
        ['follow_path_error_code', 'compute_path_error_code'],
        'The entries of the blackboard with the error codes of actions.',
    )
    error_code_name_prefixes: list[str] = parameter(
        [], 'What such names begin with, as Nav2 Kilted wants them: follow_path.'
    )
    goal_reached_tol: float = parameter(0.25, 'How near GoalReached means, in m.', low=0.0)
    goal_updater_topic: str = parameter(
        'goal_update', 'Newer goals of GoalUpdater.', read_only=True
    )
    inhibit_topic: str = parameter(
        '',
        'A latched std_msgs/String: why the robot cannot go anywhere, or empty. Not in Nav2.',
        read_only=True,
    )
    always_reload_bt_xml: bool = parameter(
        False, 'No effect: a file that was changed is always read again.'
    )


UNSUPPORTED = {
    'default_cancel_timeout': 'canceling does not wait for the servers',
    'bond_heartbeat_period': 'the lifecycle manager looks after the node otherwise',
    'service_introspection_mode': 'services are not introspected',
    'introspection_mode': 'services are not introspected',
    'allow_parameter_qos_overrides': 'QoS is fixed',
    'enable_groot_monitoring': 'Groot cannot connect; listen to behavior_tree_log',
    'groot_server_port': 'Groot cannot connect; listen to behavior_tree_log',
    'groot_zmq_publisher_port': 'Groot cannot connect; listen to behavior_tree_log',
    'groot_zmq_server_port': 'Groot cannot connect; listen to behavior_tree_log',
    'bt_search_directories': 'trees are named by their files',
}

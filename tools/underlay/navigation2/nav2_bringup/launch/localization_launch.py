# SPDX-License-Identifier: Apache-2.0
"""Localise the robot in a map with map_server and amcl."""

from __future__ import annotations

from launch import LaunchDescription
from launch.actions import GroupAction
from launch.conditions import IfCondition
from launch.substitutions import EqualsSubstitution, LaunchConfiguration, NotEqualsSubstitution
from nav2_bringup.servers import declared, Server, server_actions

MANAGER = 'lifecycle_manager_localization'
YAML_FILENAME = 'map_server.ros__parameters.yaml_filename'
SERVERS = [
    Server('nav2_map_server', 'map_server', 'nav2_map_server::MapServer', 'map_server'),
    Server('nav2_amcl', 'amcl', 'nav2_amcl::AmclNode', 'amcl'),
]


def generate_launch_description() -> LaunchDescription:
    """Start the two servers and their manager."""
    given = LaunchConfiguration('map')
    return LaunchDescription(
        [
            *declared(
                'namespace',
                'map',
                'use_sim_time',
                'params_file',
                'autostart',
                'use_composition',
                'container_name',
                'use_respawn',
                'log_level',
                use_composition='False',
            ),
            GroupAction(
                server_actions(SERVERS, MANAGER, {YAML_FILENAME: given}),
                condition=IfCondition(NotEqualsSubstitution(given, '')),
            ),
            GroupAction(  # with the map from the parameter file
                server_actions(SERVERS, MANAGER),
                condition=IfCondition(EqualsSubstitution(given, '')),
            ),
        ]
    )

# SPDX-License-Identifier: Apache-2.0
"""The launch files and executables, in processes of their own."""

from __future__ import annotations

import os
import signal
import subprocess

from lifecycle_msgs.msg import State
from lifecycle_msgs.srv import GetState
import pytest
from rcl_interfaces.srv import GetParameters


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize('kind', ['async', 'sync', 'localization'])
def test_executable_ends_well(ros, domain, kind, number):
    """A signal ends each node with status 0 and without a traceback."""
    name = f'{kind}_{int(number)}'
    remapped = ['--ros-args', '-r', f'__node:={name}']
    command = ['ros2', 'run', 'slam_toolbox', f'{kind}_slam_toolbox_node', *remapped]
    program = _start(command, domain)
    node = ros.node('watcher')
    ros.wait_until(lambda: name in node.get_node_names(), 30.0, 'the node')
    program.send_signal(number)
    output, _ = program.communicate(timeout=20.0)
    assert program.returncode == 0, output
    assert 'Traceback' not in output


@pytest.mark.parametrize(
    'file', ['online_async_launch.py', 'online_sync_launch.py', 'localization_launch.py']
)
def test_launch_file_activates_the_node(ros, domain, file):
    """The node of a namespace is configured with the file's parameters and activated."""
    command = ['ros2', 'launch', 'slam_toolbox', file, 'namespace:=robot1', 'use_sim_time:=false']
    program = _start(command, domain)
    try:
        ros.wait_until(
            lambda: (
                ros.ask(GetState, '/robot1/slam_toolbox/get_state').current_state.id
                == State.PRIMARY_STATE_ACTIVE
            ),
            30.0,
            'the active node',
        )
        ros.wait_until(
            lambda: '/robot1/map' in dict(ros.nodes[0].get_topic_names_and_types()), 10.0, 'map'
        )
        assert '/map' not in dict(ros.nodes[0].get_topic_names_and_types())
        request = GetParameters.Request(names=['minimum_travel_distance'])
        found = ros.ask(GetParameters, '/robot1/slam_toolbox/get_parameters', request)
        assert found.values[0].double_value == 0.3
    finally:
        program.send_signal(signal.SIGINT)
        output, _ = program.communicate(timeout=20.0)
    assert 'There is no parameter' not in output
    assert 'has no effect' not in output
    assert 'Traceback' not in output


def _start(command, domain):
    local = {'ROS_DOMAIN_ID': str(domain), 'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST'}
    return subprocess.Popen(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        env={**os.environ, **local},
    )

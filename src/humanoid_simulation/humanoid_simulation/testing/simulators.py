# SPDX-License-Identifier: Apache-2.0
"""Run simulators for the duration of a test."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from humanoid_common.testing.processes import module_command, running_program
from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_simulation.testing.simulated_robot import RobotClient

FASTER = {'real_time_factor': '4.0'}
"""Not as fast as possible: commands of a test must still arrive in time on a busy computer."""


@contextmanager
def simulation(**parameters: str) -> Iterator[RosSandbox]:
    """
    Run a simulator without cameras in a ROS domain of its own.

    Parameters
    ----------
    **parameters
        Parameters of the node as text, in addition to or instead of those of tests.

    Yields
    ------
    RosSandbox
        The nodes of the test, in the domain of the simulator.

    """
    values = {**FASTER, 'camera_rate_hz': '0.0', **parameters}
    settings = [text for name, value in values.items() for text in ('-p', f'{name}:={value}')]
    command = module_command('humanoid_simulation.starting', '--ros-args', *settings)
    with ros_sandbox() as ros, running_program(command) as program:
        program.wait_for_output('Simulator started', timeout_s=60.0)
        yield ros


@contextmanager
def simulated_robot(**parameters: str) -> Iterator[RobotClient]:
    """
    Run a simulator without cameras, and connect to its robot.

    Parameters
    ----------
    **parameters
        As for `simulation`.

    Yields
    ------
    RobotClient
        The robot; its time runs unless it was started paused.

    """
    with simulation(**parameters) as ros:
        yield RobotClient(ros, runs=parameters.get('start_paused') != 'true')

# SPDX-License-Identifier: Apache-2.0
"""Simulators for the duration of a test: drive, push and watch their robots, in simulated time."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
import math
from typing import Any

from humanoid_common.testing.processes import module_command, running_program
from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_control.walking.commands import VelocityCommand
from humanoid_control.walking.planar import PlanarPose
from humanoid_simulation.examples.conversions import push_request, refusal, state_request
from humanoid_simulation.examples.fall_watch import FallWatch
from humanoid_simulation.examples.push_series import Push
from humanoid_simulation.testing.clients import RobotTopics
from rclpy.client import Client
from rclpy.node import Node
from simulation_interfaces.msg import EntityState
from simulation_interfaces.srv import ResetSimulation, SetEntityState, StepSimulation
from std_srvs.srv import Trigger

FASTER = {'real_time_factor': '4.0'}
"""Not as fast as possible: commands of a test must still arrive in time on a busy computer."""
PATIENCE_S = 60.0
"""Timeout in real time for responses that should arrive at once."""
PUSH_S = 0.1
"""Duration of a push."""


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


class FellError(AssertionError):
    """The robot fell."""


class RobotClient:
    """
    Client of a robot in a running simulator; the robot must stay on its feet throughout a test.

    Parameters
    ----------
    ros
        The nodes of the test, in the domain of the simulator.
    namespace
        Namespace of the robot; '' if it has none.
    simulator
        Name of the simulator node, with its namespace.
    runs
        Whether the simulation is not paused, so that ground truth must arrive.

    Attributes
    ----------
    topics
        The topics and services of the robot.

    Raises
    ------
    WaitedInVainError
        The simulator or its ground truth is not available within `PATIENCE_S`.

    """

    def __init__(
        self,
        ros: RosSandbox,
        namespace: str = '',
        simulator: str = '/simulator',
        runs: bool = True,
    ) -> None:
        self._ros = ros
        self._namespace = namespace
        node = ros.start(lambda **options: Node('robot_watcher', namespace=namespace, **options))
        self.topics = RobotTopics(node, simulator)
        ros.wait_until(lambda: self.topics.is_complete, PATIENCE_S, 'the simulator')
        if runs:
            ros.wait_until(lambda: self.topics.time_s > 0.0, PATIENCE_S, 'ground truth')
        self._fall_watch = FallWatch()

    @property
    def pose(self) -> PlanarPose:
        """Return the true pose of the robot on the ground."""
        return self.topics.pose

    @property
    def stands(self) -> bool:
        """Whether the robot has not fallen."""
        return self._fall_watch.stands(self.topics.height_m, self.topics.tilt_rad)

    def wait(self, duration_s: float) -> None:
        """
        Wait for a duration in simulated time.

        Parameters
        ----------
        duration_s
            The duration, in s of simulated time.

        Raises
        ------
        FellError
            The robot fell.

        """
        self.wait_until(lambda: False, duration_s)

    def wait_until(self, done: Callable[[], bool], at_most_s: float) -> bool:
        """
        Wait in simulated time until a condition holds.

        Parameters
        ----------
        done
            The condition.
        at_most_s
            Timeout, in s of simulated time.

        Returns
        -------
        bool
            Whether the condition holds at the end.

        Raises
        ------
        FellError
            The robot fell.

        """
        end_s = self.topics.time_s + at_most_s
        self._spin(lambda: done() or not self.stands or self.topics.time_s >= end_s, at_most_s)
        if not self.stands:
            topics = self.topics
            raise FellError(
                f'The robot fell before {topics.time_s:.2f} s: its base is at '
                f'{topics.height_m:.2f} m and leans {topics.tilt_rad:.2f} rad. It was driven '
                f'with {topics.velocity}, and its state is {topics.walking_state!r}'
            )
        return done()

    def drive(self, forward: float = 0.0, left: float = 0.0, turn: float = 0.0) -> None:
        """
        Command a velocity from now on; without arguments, stand.

        Parameters
        ----------
        forward, left
            Linear velocity in the axes of the robot, in m/s.
        turn
            Yaw rate, anticlockwise, in rad/s.

        """
        self.topics.drive(VelocityCommand(forward, left, turn))

    def push(self, direction: str, impulse_ns: float) -> None:
        """
        Push the base for `PUSH_S`; returns at once.

        Parameters
        ----------
        direction
            Relative to the present heading of the robot: 'forward', 'back', 'left' or 'right'.
        impulse_ns
            Force times duration, in N s.

        """
        push = Push(direction, impulse_ns)
        self._ask(self.topics.push, push_request(push, self._namespace, self.pose, PUSH_S))

    def reset(self) -> None:
        """Reset the simulation, and let the robot stand for a second."""
        self.drive()
        self._ask(self.topics.reset, ResetSimulation.Request())
        self._fall_watch, begin_s = FallWatch(), self.topics.time_s
        self._spin(lambda: self.topics.time_s > begin_s + 0.1, 0.1)
        self.wait(1.0)

    def let_go(self) -> None:
        """Stop sending velocity commands, so that another node can drive the robot."""
        self.topics.velocity = None

    def put(self, pose: PlanarPose) -> None:
        """
        Move the robot without changing its height or joints, and let it stand for a second.

        Parameters
        ----------
        pose
            The new pose, upright, in the world frame.

        Raises
        ------
        FellError
            The robot fell.

        """
        self.drive()
        state = EntityState()
        position, orientation = state.pose.position, state.pose.orientation
        position.x, position.y = pose.position_m.real, pose.position_m.imag
        position.z = self.topics.height_m
        orientation.w, orientation.z = math.cos(pose.yaw_rad / 2.0), math.sin(pose.yaw_rad / 2.0)
        entity = self._namespace.strip('/') or 'robot'
        self._ros.wait_until(self.topics.put.service_is_ready, PATIENCE_S, 'the entities')
        self._ask(self.topics.put, SetEntityState.Request(entity=entity, state=state))
        self.wait(1.0)

    def stand_up(self) -> None:
        """Help a fallen robot onto its feet, and let it stand for a second."""
        self.drive()
        self._ask(self.topics.stand_up, Trigger.Request())
        self._ros.wait_until(self._walks, PATIENCE_S, 'a robot that stands by itself')
        self.wait(1.0)

    def _walks(self) -> bool:
        """Check whether the robot stands by its walking controller, not only by the hoist."""
        return self.stands and self.topics.walking_state == 'stand'

    def pause(self, on: bool = True) -> None:
        """
        Pause or resume the simulation.

        Parameters
        ----------
        on
            Whether to pause it.

        """
        self._ask(self.topics.pause, state_request(on))

    def step(self, steps: int) -> None:
        """
        Advance a paused simulation.

        Parameters
        ----------
        steps
            Number of physics steps.

        """
        self._ask(self.topics.steps, StepSimulation.Request(steps=steps))

    def hear_of(self, time_s: float) -> None:
        """
        Wait until the ground truth of a simulated time has arrived.

        Parameters
        ----------
        time_s
            A time that the simulator has reached already.

        """
        self._spin(lambda: self.topics.time_s > time_s - 1e-6, 0.0)

    def step_commanded(self, steps: int) -> None:
        """
        Advance a paused simulation just after a velocity command has certainly arrived.

        The result is reproducible as long as the command does not expire within the steps.

        Parameters
        ----------
        steps
            Number of physics steps.

        """
        sent = self.topics.sent
        self._ros.wait_until(lambda: self.topics.sent > sent + 1, PATIENCE_S, 'a velocity')
        self.step(steps)

    def _ask(self, client: Client, request: Any) -> None:
        """Send a request, and assert that it succeeds."""
        future = client.call_async(request)
        self._ros.wait_until(future.done, PATIENCE_S, f'an answer of {client.srv_name}')
        reason = refusal(future.result())
        assert not reason, f'{client.srv_name} refused: {reason}'

    def _spin(self, done: Callable[[], bool], duration_s: float) -> None:
        """Spin until a condition holds."""
        patience_s = PATIENCE_S + 3 * duration_s
        self._ros.wait_until(done, patience_s, f'{duration_s:g} s of simulated time')

# SPDX-License-Identifier: Apache-2.0
"""Clients of a simulator: of the topics and services of a robot, and of those of all entities."""

from __future__ import annotations

import math
from typing import Any

from geometry_msgs.msg import Twist, Vector3, Wrench
from humanoid_common.qos import COMMAND, LATCHED, STATE
from humanoid_common.testing.ros import RosSandbox
from humanoid_control.hosting.conversions import seconds
from humanoid_control.walking.commands import VelocityCommand
from humanoid_control.walking.planar import PlanarPose
from humanoid_interfaces.srv import ApplyWrench
from humanoid_simulation.examples.conversions import (
    height_and_tilt,
    planar_pose,
    refusal,
    twist_message,
)
from nav_msgs.msg import Odometry
from rclpy.duration import Duration
from rclpy.node import Node
from sensor_msgs.msg import JointState
from simulation_interfaces.srv import (
    GetEntityState,
    ResetSimulation,
    SetEntityState,
    SetSimulationState,
    StepSimulation,
)
from std_msgs.msg import Bool, String
from std_srvs.srv import Trigger

__all__ = ['EntityClient', 'RobotTopics']

REPEAT_S = 0.03
"""Period in real time at which commands are repeated, so that they do not time out."""
_PATIENCE_S = 60.0
_SERVICES = {
    'get_entity_state': GetEntityState,
    'set_entity_state': SetEntityState,
    'apply_wrench': ApplyWrench,
}


class RobotTopics:
    """
    Subscribers, repeating command publishers, and service clients of a simulated robot.

    Parameters
    ----------
    node
        The node that subscribes and publishes, in the namespace of the robot.
    simulator
        Name of the simulator node, with its namespace: `/simulator`.

    Attributes
    ----------
    velocity
        The command that is repeated on `cmd_vel`; None for none.
    time_s
        Stamp of the newest ground truth; minus infinity before the first one.
    pose, height_m, tilt_rad
        True pose on the ground and height of the base, in the world frame, and its tilt.
    odometry
        Pose on the ground by odometry, in `odom`.
    positions_rad
        Measured positions by the names of the joints.
    walking_state
        The newest state on `walking_state`.
    pause, steps, reset, put, push, stand_up
        Clients of the services of the simulator.
    emergency_stop
        Publisher of the emergency stop.

    """

    def __init__(self, node: Node, simulator: str) -> None:
        self.velocity: VelocityCommand | None = None
        self.joint_commands: dict[str, float] = {}
        """Joint positions that are repeated on `joint_commands`, in rad; none if it is empty."""
        self.sent = 0
        """The number of velocity commands that have been sent."""
        self.time_s = -math.inf
        self.pose = PlanarPose()
        self.odometry = PlanarPose()
        self.height_m = self.tilt_rad = math.nan
        self.positions_rad: dict[str, float] = {}
        self.walking_state = ''
        self.went_back = False
        """Whether a stamp was older than the one before it."""
        self.pause = node.create_client(SetSimulationState, f'{simulator}/set_simulation_state')
        self.steps = node.create_client(StepSimulation, f'{simulator}/step_simulation')
        self.reset = node.create_client(ResetSimulation, f'{simulator}/reset_simulation')
        self.put = node.create_client(SetEntityState, f'{simulator}/set_entity_state')
        self.push = node.create_client(ApplyWrench, f'{simulator}/apply_wrench')
        self.stand_up = node.create_client(Trigger, 'stand_up')
        self.emergency_stop = node.create_publisher(Bool, 'emergency_stop', LATCHED)
        self._joints = node.create_publisher(JointState, 'joint_commands', COMMAND)
        self._publisher = node.create_publisher(Twist, 'cmd_vel', COMMAND)
        node.create_subscription(Odometry, 'ground_truth/odom', self._take_truth, STATE)
        node.create_subscription(Odometry, 'odom', self._take_odometry, STATE)
        node.create_subscription(JointState, 'joint_states', self._take_joints, STATE)
        node.create_subscription(String, 'walking_state', self._take_state, LATCHED)
        node.create_timer(REPEAT_S, self.send)

    @property
    def is_complete(self) -> bool:
        """Whether all services and subscribers of the simulator that tests use are available."""
        clients = (self.pause, self.steps, self.reset, self.push)
        is_heard = self._publisher.get_subscription_count() > 0
        return is_heard and all(each.service_is_ready() for each in clients)

    def send(self) -> None:
        """Publish the current commands."""
        if self.velocity is not None:
            self._publisher.publish(twist_message(self.velocity))
            self.sent += 1
        if self.joint_commands:
            names, positions = list(self.joint_commands), list(self.joint_commands.values())
            self._joints.publish(JointState(name=names, position=positions))

    def drive(self, velocity: VelocityCommand | None) -> None:
        """
        Send a velocity command, and repeat it from now on.

        Parameters
        ----------
        velocity
            The command; None stops sending, so that another node can drive.

        """
        self.velocity = velocity
        self.send()

    def _take_truth(self, message: Odometry) -> None:
        """Store the ground truth of the base."""
        time_s = seconds(message.header.stamp)
        self.went_back |= time_s < self.time_s
        self.time_s, self.pose = time_s, planar_pose(message)
        self.height_m, self.tilt_rad = height_and_tilt(message)

    def _take_odometry(self, message: Odometry) -> None:
        """Store the odometry."""
        self.odometry = planar_pose(message)

    def _take_joints(self, message: JointState) -> None:
        """Store the joint positions."""
        self.positions_rad = dict(zip(message.name, message.position))

    def _take_state(self, message: String) -> None:
        """Store the walking state."""
        self.walking_state = message.data


class EntityClient:
    """
    Client of the entity services of a simulator.

    Parameters
    ----------
    ros
        The nodes of the test.
    simulator
        The name of the simulator's node.

    """

    def __init__(self, ros: RosSandbox, simulator: str = 'simulator') -> None:
        self._ros, node = ros, ros.observer()
        self._clients = {
            name: node.create_client(kind, f'{simulator}/{name}')
            for name, kind in _SERVICES.items()
        }
        for name, client in self._clients.items():
            ros.wait_until(client.service_is_ready, _PATIENCE_S, name)

    def position_m(self, name: str) -> tuple[float, float, float]:
        """
        Query the true position of an entity.

        Parameters
        ----------
        name
            The name of the object or robot.

        Returns
        -------
        float, float, float
            The origin of the object, or of the base of the robot, in m in the world frame.

        """
        answer = self._ask('get_entity_state', GetEntityState.Request(entity=name))
        position = answer.state.pose.position
        return position.x, position.y, position.z

    def put(self, name: str, at_m: tuple[float, float, float], yaw_rad: float = 0.0) -> None:
        """
        Move an entity, upright and at rest.

        Parameters
        ----------
        name
            The name of the object or robot.
        at_m
            The new position (3,) of its origin, in the world frame.
        yaw_rad
            Its new heading.

        """
        request = SetEntityState.Request(entity=name)
        pose = request.state.pose
        pose.position.x, pose.position.y, pose.position.z = at_m
        pose.orientation.w, pose.orientation.z = math.cos(yaw_rad / 2.0), math.sin(yaw_rad / 2.0)
        self._ask('set_entity_state', request)

    def pull(
        self, name: str, force_n: tuple[float, float, float], duration_s: float = 1.0
    ) -> None:
        """
        Apply a force at the origin of an entity; returns at once.

        Parameters
        ----------
        name
            The name of the object or robot.
        force_n
            The force (3,), in the world frame.
        duration_s
            Its duration, in s of simulated time.

        """
        x, y, z = force_n
        request = ApplyWrench.Request(entity=name, wrench=Wrench(force=Vector3(x=x, y=y, z=z)))
        request.duration = Duration(seconds=duration_s).to_msg()
        self._ask('apply_wrench', request)

    def _ask(self, name: str, request: Any) -> Any:
        """Call a service, assert that it succeeds, and return the response."""
        future = self._clients[name].call_async(request)
        self._ros.wait_until(future.done, _PATIENCE_S, f'an answer of {name}')
        reason = refusal(future.result())
        assert not reason, f'{name} refused: {reason}'
        return future.result()

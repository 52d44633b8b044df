# SPDX-License-Identifier: Apache-2.0
"""A simulated robot in front of a table with a can, for tests."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
import re
from typing import Any, TypeVar

from humanoid_common.qos import LATCHED, SENSOR
from humanoid_common.testing.actions import ActionCaller, End
from humanoid_common.testing.launching import running_launch_file
from humanoid_common.testing.processes import RunningProgram
from humanoid_common.testing.ros import RosSandbox
from humanoid_description.expansion import humanoid_urdf
from humanoid_interfaces.action import Drop, HandOver, Pick, Place
from humanoid_simulation.testing.clients import EntityClient
from humanoid_simulation.testing.simulators import RobotClient, simulation
from rclpy.node import Node
from sensor_msgs.msg import JointState
from vision_msgs.msg import Detection3D, Detection3DArray, ObjectHypothesisWithPose

__all__ = ['CAN_M', 'PATIENCE_S', 'TableWorld', 'table_world']

CAN_M = (0.62, 0.15, 0.76)
"""The initial position of the can."""
PATIENCE_S = 240.0
NodeT = TypeVar('NodeT', bound=Node)
_SCENE = """\
things:
  - {name: table, shape: box, size: [0.7, 1.2, 0.7], position: [0.85, 0, 0.35]}
  - {name: can, shape: cylinder, size: [0.033, 0.12], position: [0.62, 0.15, 0.76], mass: 0.35}
"""
_PLACES = """\
frame: odom
surfaces:
  - {name: table, height: 0.70, outline: [[0.5, -0.6], [1.2, -0.6], [1.2, 0.6], [0.5, 0.6]]}
"""
_LAUNCH = """\
from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch.substitutions import PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    parameters = {'robot_description': open(%r).read(), 'use_sim_time': True}
    states = Node(
        package='robot_state_publisher', executable='robot_state_publisher',
        parameters=[parameters],
    )
    path = [FindPackageShare('humanoid_manipulation'), 'launch', 'manipulation.launch.py']
    manipulation = IncludeLaunchDescription(
        PathJoinSubstitution(path),
        launch_arguments={'places_file': %r, 'use_sim_time': 'true'}.items(),
    )
    return LaunchDescription([states, manipulation][:%d])
"""
_STARTED = re.compile(r'\[manipulator-\d+\]: process started with pid \[(\d+)\]')
_KINDS = {'pick': Pick, 'place': Place, 'hand_over': HandOver, 'drop': Drop}


class TableWorld:
    """
    A robot in front of a table, action clients of its manipulator, and a faked object memory.

    Parameters
    ----------
    ros
        The sandbox of the test's nodes.
    program
        The launch that has started the other nodes.

    """

    def __init__(self, ros: RosSandbox, program: RunningProgram) -> None:
        self.ros, self.robot, self.program = ros, RobotClient(ros), program
        self._joints: dict[str, float] = {}
        self._velocities: dict[str, float] = {}
        self._node = node = ros.observer()
        node.create_subscription(JointState, 'joint_states', self._take, SENSOR)
        self._objects = node.create_publisher(Detection3DArray, 'objects', LATCHED)
        self.entities = EntityClient(ros)
        self._callers = {name: ActionCaller(ros, kind, name) for name, kind in _KINDS.items()}

    @property
    def arm_speed_rad_s(self) -> float:
        """Return the greatest velocity of the arm joints."""
        return max(
            abs(speed)
            for joint, speed in self._velocities.items()
            if any(part in joint for part in ('shoulder', 'elbow', 'wrist'))
        )

    @property
    def manipulators(self) -> list[int]:
        """Return the process ids of the manipulator nodes that the launch has started."""
        return [int(pid) for pid in _STARTED.findall(self.program.output)]

    @property
    def endpoints(self) -> frozenset[bytes]:
        """Return the endpoint GIDs of the manipulator nodes, also of one that was just killed."""
        found = self._node.get_publishers_info_by_topic('held_objects')
        return frozenset(bytes(each.endpoint_gid) for each in found)

    def _take(self, message: JointState) -> None:
        self._joints.update(zip(message.name, message.position))
        self._velocities.update(zip(message.name, message.velocity))

    @property
    def can_m(self) -> tuple[float, float, float]:
        """Return the ground-truth position of the can."""
        return self.entities.position_m('can')

    def remember(self) -> None:
        """Publish the can at its ground-truth position as a remembered object."""
        can = Detection3D(id='red_can_1')
        for name in ('can', 'red can'):
            result = ObjectHypothesisWithPose()
            result.hypothesis.class_id, result.hypothesis.score = name, 0.9
            can.results.append(result)
        at, size = can.bbox.center.position, can.bbox.size
        at.x, at.y, at.z = self.can_m
        size.x = size.y = 0.066
        size.z = 0.12
        message = Detection3DArray(detections=[can])
        message.header.frame_id = 'odom'
        self._objects.publish(message)

    def act(self, name: str, **fields: Any) -> End:
        """
        Send a goal, wait for its result, and check that the robot still stands.

        Parameters
        ----------
        name
            The action: `pick`, `place`, `hand_over` or `drop`.
        **fields
            The fields of the goal.

        Returns
        -------
        End
            The status and the result of the goal.

        """
        end = self._callers[name].end_of(self.start(name, **fields), PATIENCE_S)
        assert self.robot.stands
        return end

    def start(self, name: str, **fields: Any) -> Any:
        """
        Send a goal, and discard the feedback of earlier ones.

        Parameters
        ----------
        name, **fields
            As for `act`.

        Returns
        -------
        Any
            The goal handle, for `end_of`.

        """
        self._callers[name].feedback.clear()
        return self._callers[name].send(**fields)

    def end_of(self, name: str, handle: Any) -> End:
        """
        Wait for the result of an accepted goal.

        Parameters
        ----------
        name, handle
            The action, and the goal handle from `start`.

        Returns
        -------
        End
            The status and the result of the goal.

        """
        return self._callers[name].end_of(handle, PATIENCE_S)

    def states(self, name: str) -> list[str]:
        """
        List the states in the feedback of the newest goal of an action.

        Parameters
        ----------
        name
            The action.

        """
        return [each.state for each in self._callers[name].feedback]

    def joint_rad(self, name: str) -> float:
        """
        Return the latest position of a joint (rad).

        Parameters
        ----------
        name
            The name of the joint.

        """
        return self._joints[name]

    def pull(self) -> None:
        """Pull on the can."""
        self.entities.pull('can', (12.0, 0.0, 0.0))

    def close(self) -> None:
        """Destroy the action clients."""
        for caller in self._callers.values():
            caller.close()


@contextmanager
def table_world(
    folder: Path, real_time_factor: float, manipulator: Callable[..., NodeT] | None = None
) -> Iterator[tuple[TableWorld, NodeT | None]]:
    """
    Start a simulated robot in front of a table, and its manipulator node.

    Parameters
    ----------
    folder
        A folder for the files of the scene.
    real_time_factor
        The real-time factor of the simulation.
    manipulator
        Creates the manipulator node in this process. Without it, the node is launched in a process
        of its own, and None is yielded for it.

    """
    scene, places = folder / 'kitchen.yaml', folder / 'places.yaml'
    urdf, launched = folder / 'humanoid.urdf', folder / 'table.launch.py'
    scene.write_text(_SCENE)
    places.write_text(_PLACES)
    urdf.write_text(humanoid_urdf(hands=True))
    launched.write_text(_LAUNCH % (str(urdf), str(places), 1 if manipulator else 2))
    parameters = {'scene': str(scene), 'hands': 'true', 'real_time_factor': f'{real_time_factor}'}
    with simulation(**parameters) as ros, running_launch_file(launched) as program:
        own = {'places_file': str(places), 'use_sim_time': True}
        node = ros.start(manipulator, own) if manipulator else None
        world = TableWorld(ros, program)
        yield world, node
        world.close()

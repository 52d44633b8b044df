# SPDX-License-Identifier: Apache-2.0
"""Take a can from a table in the simulator, put it down, and hand it over."""

from __future__ import annotations

from collections.abc import Iterator
import math
from pathlib import Path
from typing import Any

from action_msgs.msg import GoalStatus
from humanoid_common.qos import LATCHED, SENSOR
from humanoid_common.testing.actions import ActionCaller, End
from humanoid_common.testing.launching import running_launch_file
from humanoid_common.testing.ros import RosSandbox
from humanoid_description.expansion import humanoid_urdf
from humanoid_interfaces.action import Drop, HandOver, Pick, Place
from humanoid_manipulation.manipulator import Manipulator
from humanoid_simulation.testing.entities import Entities
from humanoid_simulation.testing.simulated_robot import SimulatedRobot
from humanoid_simulation.testing.simulators import simulation
import pytest
from sensor_msgs.msg import JointState
from vision_msgs.msg import Detection3D, Detection3DArray, ObjectHypothesisWithPose

SCENE = """\
things:
  - {name: table, shape: box, size: [0.7, 1.2, 0.7], position: [0.85, 0, 0.35]}
  - {name: can, shape: cylinder, size: [0.033, 0.12], position: [0.62, 0.15, 0.76], mass: 0.35}
"""
PLACES = """\
frame: odom
surfaces:
  - {name: table, height: 0.70, outline: [[0.5, -0.6], [1.2, -0.6], [1.2, 0.6], [0.5, 0.6]]}
"""
STATE_PUBLISHER = """\
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    parameters = {'robot_description': open(%r).read(), 'use_sim_time': True}
    node = Node(
        package='robot_state_publisher', executable='robot_state_publisher',
        parameters=[parameters],
    )
    return LaunchDescription([node])
"""
PATIENCE_S = 240.0
KINDS = {'pick': Pick, 'place': Place, 'hand_over': HandOver, 'drop': Drop}

pytestmark = pytest.mark.timeout(400)


class World:
    """A robot before a table, what moves its arms, and a memory of the can that is right."""

    def __init__(self, ros: RosSandbox, places: Path) -> None:
        """Start the manipulator."""
        self.ros, self.robot = ros, SimulatedRobot(ros)
        self._joints: dict[str, float] = {}
        node = ros.observer()
        node.create_subscription(
            JointState,
            'joint_states',
            lambda message: self._joints.update(zip(message.name, message.position)),
            SENSOR,
        )
        self._objects = node.create_publisher(Detection3DArray, 'objects', LATCHED)
        self._entities = Entities(ros)
        self.manipulator = ros.start(
            Manipulator, {'places_file': str(places), 'use_sim_time': True}
        )
        self._callers = {name: ActionCaller(ros, kind, name) for name, kind in KINDS.items()}

    @property
    def can_m(self) -> tuple[float, float, float]:
        """Return where the can truly is."""
        return self._entities.position_m('can')

    def remember(self) -> None:
        """Let the robot remember the can where it is."""
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
        """Do a goal, and return its end; the robot stays on its feet."""
        end = self._callers[name].end_of(self.start(name, **fields), PATIENCE_S)
        assert self.robot.stands
        return end

    def start(self, name: str, **fields: Any) -> Any:
        """Begin a goal, and return its handle."""
        self._callers[name].feedback.clear()
        return self._callers[name].send(**fields)

    def end_of(self, name: str, handle: Any) -> End:
        """Return how a goal ends."""
        return self._callers[name].end_of(handle, PATIENCE_S)

    def states(self, name: str) -> list[str]:
        """Return what the newest goal of an action has told of itself."""
        return [each.state for each in self._callers[name].feedback]

    def joint_rad(self, name: str) -> float:
        """Return where a joint is."""
        return self._joints[name]

    def pull(self) -> None:
        """Pull at the can."""
        self._entities.pull('can', (12.0, 0.0, 0.0))

    def close(self) -> None:
        """End."""
        for caller in self._callers.values():
            caller.close()


@pytest.fixture(name='world', scope='module')
def _world(tmp_path_factory: pytest.TempPathFactory) -> Iterator[World]:
    """Give a robot before a table."""
    folder = tmp_path_factory.mktemp('manipulation')
    scene, places = folder / 'kitchen.yaml', folder / 'places.yaml'
    urdf, launched = folder / 'humanoid.urdf', folder / 'states.launch.py'
    scene.write_text(SCENE)
    places.write_text(PLACES)
    urdf.write_text(humanoid_urdf(hands=True))
    launched.write_text(STATE_PUBLISHER % str(urdf))
    parameters = {'scene': str(scene), 'hands': 'true', 'real_time_factor': '1.5'}
    with simulation(**parameters) as ros, running_launch_file(launched):
        world = World(ros, places)
        yield world
        world.close()


def test_what_is_not_there_is_not_taken(world: World) -> None:
    """Each reason has its code."""
    end = world.act('pick', object='unicorn')
    assert end.status == GoalStatus.STATUS_ABORTED
    assert end.result.error_code == Pick.Result.NOT_SEEN
    assert "'unicorn'" in end.result.error_msg
    for name, code in (
        ('place', Place.Result.EMPTY_HAND),
        ('hand_over', HandOver.Result.EMPTY_HAND),
        ('drop', Drop.Result.EMPTY_HAND),
    ):
        assert world.act(name).result.error_code == code


def test_a_canceled_goal_leaves_the_can_and_the_robot_in_order(world: World) -> None:
    """The hand comes back, and the robot stands upright."""
    world.remember()
    world.robot.wait(0.5)
    before = world.can_m
    goal = world.start('pick', object='can')
    world.ros.wait_until(
        lambda: 'reaching' in world.states('pick'), PATIENCE_S, 'a hand on its way'
    )
    world.robot.wait(0.7)
    goal.cancel_goal_async()
    assert world.end_of('pick', goal).status == GoalStatus.STATUS_CANCELED
    assert world.can_m == pytest.approx(before, abs=0.02)
    world.robot.wait(1.0)
    for side in ('left', 'right'):
        assert world.joint_rad(f'{side}_elbow') == pytest.approx(-0.5, abs=0.1)


def test_a_can_is_taken_put_down_and_handed_over(world: World) -> None:
    """It is in the hand, then on the table, then in the hand of somebody who pulls."""
    world.remember()
    world.robot.wait(0.5)
    end = world.act('pick', object='red can')
    assert end.status == GoalStatus.STATUS_SUCCEEDED, end.result.error_msg
    assert end.result.object == 'red_can_1'
    states = world.states('pick')
    assert states[-1] == 'carrying' and 'closing' in states
    world.robot.wait(3.0)
    assert world.can_m[2] > 0.80
    pose = world.robot.pose.position_m
    assert math.hypot(world.can_m[0] - pose.real, world.can_m[1] - pose.imag) < 0.5
    busy = world.act('pick', object='red can', side=end.result.side)
    assert busy.result.error_code == Pick.Result.OCCUPIED_HAND
    # As after a restart: what the hand holds is felt, not remembered.
    held = world.manipulator.held.pop(end.result.side)
    busy = world.act('pick', object='red can', side=end.result.side)
    assert busy.result.error_code == Pick.Result.OCCUPIED_HAND
    assert 'something' in busy.result.error_msg
    world.manipulator.held[end.result.side] = held

    down = world.act('place', place='table')
    assert down.status == GoalStatus.STATUS_SUCCEEDED, down.result.error_msg
    world.robot.wait(1.0)
    x, y, z = world.can_m
    assert z == pytest.approx(0.76, abs=0.02)
    assert (x, y) == pytest.approx((down.result.position.x, down.result.position.y), abs=0.06)

    world.remember()
    world.robot.wait(0.5)
    assert world.act('pick', object='red_can_1').status == GoalStatus.STATUS_SUCCEEDED
    handed = world.start('hand_over')
    world.ros.wait_until(
        lambda: 'waiting' in world.states('hand_over'), PATIENCE_S, 'a hand that is held out'
    )
    world.robot.wait(2.0)
    assert 'opening' not in world.states('hand_over')
    world.pull()
    end = world.end_of('hand_over', handed)
    assert end.status == GoalStatus.STATUS_SUCCEEDED, end.result.error_msg
    assert world.act('drop').result.error_code == Drop.Result.EMPTY_HAND

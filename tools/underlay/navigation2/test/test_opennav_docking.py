# SPDX-License-Identifier: Apache-2.0
"""Docking: to a dock and away from it, and how it ends otherwise."""

from __future__ import annotations

from collections.abc import Iterator
import math
from pathlib import Path
import sys
import time
from typing import Any

from action_msgs.msg import GoalStatus
from geometry_msgs.msg import Pose, PoseStamped, Transform, TransformStamped, Twist
from nav2_msgs.action import DockRobot, NavigateToPose, UndockRobot
from nav2_msgs.srv import ReloadDockDatabase
from nav2_util import ActionAborted, ActionServer, ConfigurationError, Pose2D
from nav2_util.geometry import make_pose_stamped, make_quaternion, planar_pose
from nav2_util.twist import Velocity
import numpy as np
from opennav_docking import DockingServer
from opennav_docking.approach import approach_velocity, ApproachParameters
from opennav_docking.detection import docking_pose, PoseFilter, quaternion_of_angles
from opennav_docking.dock_database import find_dock, make_dock, read_docks
import pytest
from rclpy.time import Time
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import BatteryState, JointState
from tf2_ros import TransformBroadcaster

sys.path.insert(0, str(Path(__file__).parent))
from navigation_servers import Client  # noqa: E402, I100

STEP_S = 0.05
SUCCEEDED = GoalStatus.STATUS_SUCCEEDED
ABORTED = GoalStatus.STATUS_ABORTED
CANCELED = GoalStatus.STATUS_CANCELED
PARAMETERS = {
    'use_sim_time': True,
    'controller_frequency': 1.0 / STEP_S,
    'fixed_frame': 'odom',
    'dock_plugins': ['charger'],
    'charger.plugin': 'opennav_docking::SimpleChargingDock',
    'charger.use_battery_status': False,
    'docks': ['home_dock'],
    'home_dock.type': 'charger',
    'home_dock.frame': 'odom',
    'home_dock.pose': [2.0, 1.0, 0.5],
    'controller.use_collision_detection': False,
    'initial_perception_timeout': 1.0,
    'wait_charge_timeout': 1.0,
}
DOCK = Pose2D(2.0, 1.0, 0.5)
STAGING = DOCK @ Pose2D(-0.7, 0.0, 0.0)


class TestDatabase:
    def test_docks_of_a_file(self, tmp_path):
        """Docks have a type, a frame and a pose; they are found by name and by id."""
        path = tmp_path / 'docks.yaml'
        path.write_text(
            'docks:\n  a: {type: t, frame: odom, pose: [1, 2.5, 0]}\n'
            '  b: {type: t, pose: [0.0, 0.0, 3.0], id: c67f}\n'
        )
        docks = read_docks(str(path))
        assert [(each.name, each.frame) for each in docks] == [('a', 'odom'), ('b', 'map')]
        assert docks[0].pose == (1.0, 2.5, 0.0)
        assert find_dock(docks, 'c67f') is find_dock(docks, 'b') is docks[1]
        assert find_dock(docks, '') is None

    @pytest.mark.parametrize(
        ('text', 'said'),
        [
            ('docks: {a: {type: t, pose: [1, 2]}}', 'must be .x, y, yaw., in m and rad'),
            ('docks: {a: {pose: [1, 2, 3]}}', "The dock 'a' has no type"),
            ('a: {type: t}', 'does not describe docks'),
            (None, 'cannot be read'),
        ],
    )
    def test_faults(self, tmp_path, text, said):
        """A file with faults is refused with a sentence."""
        path = tmp_path / 'docks.yaml'
        if text is not None:
            path.write_text(text)
        with pytest.raises(ConfigurationError, match=said):
            read_docks(str(path))

    def test_a_pose_of_texts(self):
        """A pose that is not of numbers is refused."""
        with pytest.raises(ConfigurationError, match="The pose of the dock 'x'"):
            make_dock('x', {'type': 't', 'pose': ['a', 'b', 'c']})


class TestDetection:
    def test_a_tag_on_a_wall(self):
        """The usual angles turn the frame of a tag, whose z points at the robot, to a heading."""
        turn = quaternion_of_angles(-1.57, 1.57, 0.0)
        tag = Pose()
        tag.position.x, tag.position.z = 0.3, 2.0  # to the right in the frame of a camera
        tag.orientation.x, tag.orientation.w = 1.0, 0.0  # z points back at the camera
        camera = Transform()  # looks along x, with x to the right and y down
        camera.translation.z = 0.4
        q = camera.rotation
        q.x, q.y, q.z, q.w = -0.5, 0.5, -0.5, 0.5
        found = docking_pose(tag, camera, turn, -0.5, 0.1)
        assert found == pytest.approx((1.5, -0.2, 0.0), abs=0.01)

    def test_the_filter_follows_and_forgets(self):
        """New poses count by the coefficient, also across half a turn; a gap starts anew."""
        pose_filter = PoseFilter(0.25, 1.0)
        assert pose_filter.update(Pose2D(0.0, 0.0, 3.1), 10.0) == (0.0, 0.0, 3.1)
        turned = pose_filter.update(Pose2D(4.0, 0.0, -3.1), 10.5)
        assert turned == pytest.approx((1.0, 0.0, 3.1 + 0.25 * (2 * math.pi - 6.2)))
        assert pose_filter.update(Pose2D(9.0, 0.0, 0.0), 10.5) is turned
        assert pose_filter.update(Pose2D(9.0, 0.0, 0.0), 12.0) == (9.0, 0.0, 0.0)


@pytest.mark.parametrize('backward', [False, True])
@pytest.mark.parametrize('start', [(-0.7, 0.0, 0.0), (-0.9, 0.15, 0.3), (-0.6, -0.1, -0.2)])
def test_the_approach_ends_at_the_dock(start, backward):
    """Aligned to it, and within the limits; backward, the robot faces away."""
    values = ApproachParameters()
    flip = Pose2D(0.0, 0.0, math.pi if backward else 0.0)
    pose, speeds = Pose2D(*start) @ flip, []
    while (target := pose.inverse() @ flip) and math.hypot(target.x, target.y) > 0.05:
        velocity = approach_velocity(target, values, backward=backward)
        speeds.append(velocity)
        pose = pose @ Pose2D(*velocity.poses_after(np.array([0.02]))[0])
        assert len(speeds) < 1000
    assert abs((pose.inverse() @ flip).yaw) < 0.15
    assert all((each.x < 0.0) == backward for each in speeds)
    assert max(abs(each.x) for each in speeds) <= values.v_linear_max + 1e-9
    assert max(abs(each.yaw) for each in speeds) <= values.v_angular_max + 1e-9


class World:
    """A robot that moves as it is told, in steps of simulated time, and a navigator."""

    def __init__(self, ros: Any, pose: Pose2D = STAGING, **parameters: Any) -> None:
        self.ros, self.pose, self.velocity = ros, pose, Velocity()
        self.now_ns, self._heard, self._waited_s = 10**11, False, 0.0
        self.tester = ros.node('tester')
        self.clock = self.tester.create_publisher(Clock, '/clock', 10)
        self.broadcaster = TransformBroadcaster(self.tester)
        self.tester.create_subscription(Twist, 'cmd_vel', self._on_velocity, 10)
        self.navigator: ActionServer | None = None
        self.wanted: list[PoseStamped] = []
        self.node = ros.make(DockingServer, {**PARAMETERS, **parameters})
        self.clients: list[Client] = []

    def start(self) -> World:
        """Bring the server up."""
        assert self.node.trigger_configure().name == 'SUCCESS'
        for each in self.node.companions:
            if each.executor is None:
                self.ros.executor.add_node(each)
        assert self.node.trigger_activate().name == 'SUCCESS'
        self.until(lambda: self.node.count_subscribers('cmd_vel'))
        buffer = self.node.transforms.buffer
        self.until(lambda: buffer.can_transform('odom', 'base_link', Time()))
        return self

    def close(self) -> None:
        for each in [*self.clients, *filter(None, [self.navigator])]:
            getattr(each, 'close', getattr(each, 'destroy', None))()

    def navigate(self) -> None:
        """Offer a navigator that gets everywhere at once, but not to x > 5."""
        self.navigator = ActionServer(
            self.tester, NavigateToPose, 'navigate_to_pose', self._navigate
        )
        self.navigator.activate()

    async def _navigate(self, goal: Any) -> None:
        self.wanted.append(goal.pose)
        pose = planar_pose(goal.pose.pose)
        if pose.x > 5.0:
            raise ActionAborted(208, 'A wall is there.')
        self.pose = pose @ Pose2D(0.02, 0.03, 0.05)

    def _on_velocity(self, message: Twist) -> None:
        self.velocity = Velocity(message.linear.x, message.linear.y, message.angular.z)
        self._heard = True

    def step(self) -> None:
        """Let time go on after a velocity, or when there is none for a while."""
        if not self._heard and time.monotonic() < self._waited_s:
            return
        self._heard, self._waited_s = False, time.monotonic() + 0.02
        self.now_ns += int(STEP_S * 1e9)
        self.pose = self.pose @ Pose2D(*self.velocity.poses_after(np.array([STEP_S]))[0])
        stamp = Time(nanoseconds=self.now_ns).to_msg()
        moved = TransformStamped()
        moved.header.frame_id, moved.child_frame_id, moved.header.stamp = (
            'odom',
            'base_link',
            stamp,
        )
        moved.transform.translation.x, moved.transform.translation.y = self.pose[:2]
        moved.transform.rotation = make_quaternion(self.pose.yaw)
        self.broadcaster.sendTransform(moved)
        self.clock.publish(Clock(clock=stamp))

    def until(self, predicate: Any, what: str = 'it') -> None:
        def look() -> Any:
            self.step()
            return predicate()

        self.ros.wait_until(look, 60.0, what)

    def run(self, kind: Any, name: str, **fields: Any) -> tuple[int, Any, list[int]]:
        """Send a goal; return its status, its result, and the states of the feedback."""
        client = Client(self.ros, self.tester, kind, name)
        self.clients.append(client)
        handle = client.send(**fields)
        self.until(handle.end.done, 'the end of the goal')
        self.until(lambda: self.velocity.is_zero, 'rest')
        answer = handle.end.result()
        states = [each.state for each in client.feedback if hasattr(each, 'state')]
        return answer.status, answer.result, states

    def dock(self, **fields: Any) -> tuple[int, Any, list[int]]:
        return self.run(DockRobot, 'dock_robot', **fields)

    @property
    def at_dock(self) -> Pose2D:
        """Where the robot is, relative to the dock."""
        return DOCK.inverse() @ self.pose


@pytest.fixture
def make_world(ros: Any) -> Iterator[Any]:
    """Return a function that makes a world with parameters."""
    made: list[World] = []

    def make(*arguments: Any, **parameters: Any) -> World:
        made.append(World(ros, *arguments, **parameters))
        return made[-1]

    yield make
    for each in made:
        each.close()


def test_dock_and_undock(make_world):
    """By way of the staging pose; the robot charges at the end, and no longer after leaving."""
    world = make_world(Pose2D(-3.0, 0.0, 0.0), **{'charger.use_battery_status': True})
    world.navigate()
    world.start()
    batteries = world.tester.create_publisher(BatteryState, 'battery_state', 1)

    def charge() -> None:
        near = math.hypot(*world.at_dock[:2]) < 0.06
        batteries.publish(BatteryState(current=2.0 if near else -1.0))

    timer = world.tester.create_timer(0.02, charge)
    status, result, states = world.dock(dock_id='home_dock')
    assert (status, result.error_msg) == (SUCCEEDED, '')
    assert (result.success, result.num_retries) == (True, 0)
    assert states == [1, 2, 3, 4]
    assert world.wanted[0].header.frame_id == 'odom'
    assert planar_pose(world.wanted[0].pose) == pytest.approx(STAGING, abs=1e-6)
    assert math.hypot(*world.at_dock[:2]) < 0.08
    status, result, _ = world.run(UndockRobot, 'undock_robot', max_undocking_time=30.0)
    assert (status, result.success, result.error_msg) == (SUCCEEDED, True, '')
    assert world.at_dock == pytest.approx((-0.7, 0.0, 0.0), abs=0.12)
    world.tester.destroy_timer(timer)


def test_a_detected_dock(make_world):
    """The robot goes where the sensor sees the dock, and pushes until its wheels stall."""
    given = {
        'charger.use_external_detection_pose': True,
        'charger.external_detection_translation_x': -0.2,
        'charger.external_detection_rotation_roll': 0.0,
        'charger.external_detection_rotation_pitch': 0.0,
        'charger.use_stall_detection': True,
        'charger.stall_joint_names': ['wheel'],
        'charger.filter_coef': 0.5,
    }
    world = make_world(**given).start()
    seen = DOCK @ Pose2D(0.0, 0.1, 0.0)
    detections = world.tester.create_publisher(PoseStamped, 'detected_dock_pose', 1)
    joints = world.tester.create_publisher(JointState, 'joint_states', 1)

    def see() -> None:
        stamp = Time(nanoseconds=world.now_ns).to_msg()
        detections.publish(make_pose_stamped(world.pose.inverse() @ seen, 'base_link', stamp))
        contact = (seen.inverse() @ world.pose).x > -0.19
        speed, effort = (0.0, 5.0) if contact else (3.0, 0.5)
        joints.publish(JointState(name=['wheel'], velocity=[speed], effort=[effort]))

    timer = world.tester.create_timer(0.01, see)
    status, result, _ = world.dock(dock_id='home_dock')
    assert (status, result.error_msg) == (SUCCEEDED, '')
    reached = seen.inverse() @ world.pose
    assert reached == pytest.approx((-0.19, 0.0, 0.0), abs=0.06)
    world.tester.destroy_timer(timer)


def test_a_dock_that_does_not_charge(make_world):
    """After each attempt the robot drives back; the result has their number."""
    world = make_world(**{'charger.use_battery_status': True, 'max_retries': 1}).start()
    status, result, states = world.dock(dock_id='home_dock')
    assert (status, result.error_code, result.num_retries) == (ABORTED, 906, 1)
    assert not result.success
    assert result.error_msg == 'The robot is docked, but does not charge. There were 2 attempts.'
    assert states == [1, 2, 3, 4, 5, 2, 3, 4]


def test_failures(make_world, tmp_path):
    """Each has its error code and a sentence."""
    world = make_world(max_retries=0)
    world.navigate()
    world.start()

    def failure(**fields: Any) -> tuple[int, str]:
        status, result, _ = world.dock(**fields)
        assert status == ABORTED and not result.success
        return result.error_code, result.error_msg

    code, said = failure(dock_id='home_dok')
    assert code == 901 and "Did you mean 'home_dock'?" in said
    code, said = failure(use_dock_id=False, dock_type='belt')
    assert code == 902 and "There is no dock type 'belt'." in said
    far = make_pose_stamped(Pose2D(9.0, 0.0, 0.0), 'odom', Time().to_msg())
    code, said = failure(use_dock_id=False, dock_type='charger', dock_pose=far)
    assert code == 903 and 'A wall is there.' in said

    class Wall:
        def first_collision(self, poses: Any) -> int | None:
            return 0

    world.node.approach.current = ApproachParameters()
    world.node.checker = Wall()
    code, said = failure(dock_id='home_dock')
    assert (code, said) == (905, 'There is an obstacle on the way.')
    world.node.checker = None

    path = tmp_path / 'docks.yaml'
    path.write_text('docks: {flex: {type: charger, frame: odom, pose: [0.0, 0.0, 0.0]}}')
    request = ReloadDockDatabase.Request(filepath=str(path))
    assert world.ros.call(ReloadDockDatabase, 'docking_server/reload_database', request).success
    assert failure(dock_id='home_dock')[0] == 901
    path.write_text('docks: {flex: {type: belt, pose: [0.0, 0.0, 0.0]}}')
    answer = world.ros.call(ReloadDockDatabase, 'docking_server/reload_database', request)
    assert not answer.success


def test_canceling_stops_the_robot(make_world):
    """At once."""
    world = make_world().start()
    client = Client(world.ros, world.tester, DockRobot, 'dock_robot')
    world.clients.append(client)
    handle = client.send(dock_id='home_dock')
    world.until(lambda: world.velocity.x > 0.0, 'motion')
    handle.cancel_goal_async()
    world.until(handle.end.done, 'the end')
    assert handle.end.result().status == CANCELED
    world.until(lambda: world.velocity.is_zero, 'rest')
    assert world.at_dock.x < -0.3


@pytest.mark.parametrize(
    ('given', 'said'),
    [
        ({'charger.plugin': 'opennav_docking::SimpleChargingDok'}, 'There is no dock of type'),
        ({'charger.plugin': ''}, "The dock type 'charger' of dock_plugins has no plugin"),
        ({'home_dock.type': 'chargr'}, "Did you mean 'charger'?"),
        ({'home_dock.pose': [1.0]}, "The pose of the dock 'home_dock' must be"),
    ],
)
def test_wrong_parameters(ros, capfd, given, said):
    """A server that cannot work with what it is told says why."""
    node = ros.make(DockingServer, {**PARAMETERS, **given})
    assert node.trigger_configure().name == 'FAILURE'
    assert said in capfd.readouterr().err

# SPDX-License-Identifier: Apache-2.0
"""The panel of gestures moves a robot with the controllers that its manager lists."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from control_msgs.action import FollowJointTrajectory
from controller_manager_msgs.msg import ControllerState
from controller_manager_msgs.srv import ListControllers
from geometry_msgs.msg import Pose
from live_world import live_world, LiveWorld
import pytest
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.task import Future
from robot_console.robot_link import LATCHED
from sensor_msgs.msg import JointState
from std_msgs.msg import Bool, String

URDF = """<robot name="arm"><link name="a"/><link name="b"/><joint name="elbow" type="revolute">
<parent link="a"/><child link="b"/><limit lower="-1" upper="1" velocity="9" effort="1"/></joint>
</robot>"""
FILE = """
gestures:
  Raise:
    steps: [{seconds: 1.0, joints: {elbow: 0.5}}]
  Bow:
    steps: [{seconds: 0.01, body: {pitch: 0.4}}, {seconds: 0.01, body: {}}]
"""
RAISE, BOW = 'gesture/Raise', 'gesture/Bow'


@pytest.fixture
def world(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[LiveWorld]:
    """Return a page and a robot."""
    monkeypatch.setenv('ROS_HOME', str(tmp_path))
    (tmp_path / 'gestures.yaml').write_text(FILE)
    with live_world() as world:
        yield world


class Arm:
    """A robot with one joint; its goals end when the test ends them."""

    def __init__(self, node: Any) -> None:
        """Offer the controller, and publish the state of the joint."""
        self.goals: list[FollowJointTrajectory.Goal] = []
        self.accepts, self.was_canceled = True, False
        self.end = Future()
        node.create_service(ListControllers, 'controller_manager/list_controllers', self._list)
        ActionServer(
            node,
            FollowJointTrajectory,
            'arm/follow_joint_trajectory',
            self._execute,
            goal_callback=self._check,
            cancel_callback=self._cancel,
        )
        self.walking = node.create_publisher(String, 'walking_state', LATCHED)
        self.walking.publish(String(data='stand'))
        described = node.create_publisher(String, 'robot_description', LATCHED)
        described.publish(String(data=URDF))
        states = node.create_publisher(JointState, 'joint_states', 5)
        state = JointState(name=['elbow'], position=[0.1])
        node.create_timer(0.05, lambda: states.publish(state))

    def _list(self, request: Any, response: Any) -> Any:
        response.controller = [
            ControllerState(
                name='arm', state='active', required_command_interfaces=['elbow/position']
            )
        ]
        return response

    def _check(self, goal: Any) -> GoalResponse:
        self.goals.append(goal)
        return GoalResponse.ACCEPT if self.accepts else GoalResponse.REJECT

    def _cancel(self, handle: Any) -> CancelResponse:
        self.was_canceled = True
        self.end.set_result('')
        return CancelResponse.ACCEPT

    async def _execute(self, handle: Any) -> Any:
        reason = await self.end
        self.end = Future()
        if handle.is_cancel_requested:
            handle.canceled()
        elif reason:
            handle.abort()
        else:
            handle.succeed()
        return FollowJointTrajectory.Result(error_string=reason, error_code=-4 if reason else 0)


def visit(world: LiveWorld, tmp_path: Path) -> Any:
    """Look at the panel."""
    return world.visit('gestures', Namespace='robot1', File=str(tmp_path / 'gestures.yaml'))


def reasons(buttons: Any) -> dict[str, str]:
    """Return why buttons are disabled, by their ids."""
    return {each['id']: each['why'] for each in buttons}


def test_without_a_robot(world: LiveWorld, tmp_path: Path) -> None:
    """All buttons are there, and say what is missing; a press does nothing else."""
    page = visit(world, tmp_path)
    told = page.wait_for('why', lambda why: 'the controllers of the robot are not running' in why)
    assert '/robot1/controller_manager/list_controllers' in told['why']
    page.wait_for('buttons', lambda buttons: all(reasons(buttons).values()) and len(buttons) == 2)
    page.ask('play', button=RAISE)
    page.wait_for('refusal', lambda refusal: 'are not running' in refusal)
    page.ask('save', name='x')
    page.wait_for('refusal', lambda refusal: 'are not running' in refusal)


def test_a_gesture(world: LiveWorld, tmp_path: Path) -> None:
    """It begins where the arm is; a second press cancels; failures are sentences."""
    arm = Arm(world.robot)
    page = visit(world, tmp_path)
    page.wait_for('buttons', lambda buttons: reasons(buttons).get(RAISE) == '')
    assert 'cannot bend' in reasons(page.told[-1]['buttons'])[BOW]
    page.ask('play', button=RAISE)
    told = page.wait_for('running', lambda running: running == RAISE)
    assert reasons(told['buttons'])[BOW] == "'Raise' is running. Cancel it first."
    world.wait_until(lambda: bool(arm.goals), 'no goal')
    trajectory = arm.goals[0].trajectory
    assert list(trajectory.joint_names) == ['elbow']
    assert [list(each.positions) for each in trajectory.points] == [[0.5]]
    assert [each.position for each in arm.goals[0].path_tolerance] == [0.4]
    page.told.clear()
    page.ask('play', button=RAISE)
    page.wait_for('running', lambda running: running == '')
    assert arm.was_canceled and page.told[-1]['said'] == ''
    page.ask('play', button=RAISE)
    world.wait_until(lambda: len(arm.goals) == 2, 'no goal')
    arm.end.set_result('It hit something.')
    page.wait_for('said', lambda said: said.endswith('ended the gesture: It hit something.'))
    arm.accepts = False
    page.ask('play', button=RAISE)
    page.wait_for('said', lambda said: 'rejected the gesture' in said)


def test_a_fall_ends_a_gesture(world: LiveWorld, tmp_path: Path) -> None:
    """The goal is canceled, and no other gesture can begin."""
    arm = Arm(world.robot)
    page = visit(world, tmp_path)
    page.wait_for('buttons', lambda buttons: reasons(buttons).get(RAISE) == '')
    page.ask('play', button=RAISE)
    page.wait_for('running', lambda running: running == RAISE)
    arm.walking.publish(String(data='fallen'))
    page.wait_for(
        'said', lambda said: said == "'Raise' was ended. The robot has fallen. Stand it up first."
    )
    page.wait_for('why', lambda why: why.startswith('The robot has fallen'))


def test_a_bow(world: LiveWorld, tmp_path: Path) -> None:
    """The body is bent and straightened; a stop and another person keep it from that."""
    Arm(world.robot)
    poses: list[Pose] = []
    world.robot.create_subscription(Pose, 'body_pose', poses.append, 5)
    page = visit(world, tmp_path)
    page.wait_for('buttons', lambda buttons: reasons(buttons).get(BOW) == '')
    page.ask('play', button=BOW)
    world.wait_until(lambda: len(poses) == 2, 'not bent')
    assert poses[0].orientation.y == pytest.approx(0.1987, abs=1e-3)
    assert (poses[1].orientation.y, poses[1].orientation.w) == (0.0, 1.0)
    world.wait_until(lambda: world.panels[0]._running is None, 'it goes on')
    link = world.panels[0]._link
    link.control.take('ann', 'seat')
    page.ask('play', button=BOW)
    page.wait_for('refusal', lambda refusal: refusal == 'ann is in control.')
    link.control.give('seat')
    stop = world.robot.create_publisher(Bool, 'emergency_stop', LATCHED)
    stop.publish(Bool(data=True))
    page.wait_for('why', lambda why: why.startswith('The emergency stop is pressed'))
    page.ask('play', button=BOW)
    page.wait_for('refusal', lambda refusal: refusal.startswith('The emergency stop'))
    assert len(poses) == 2


def test_saved_poses(world: LiveWorld, tmp_path: Path) -> None:
    """A pose is saved with its joints, is a button at once, and can be deleted."""
    Arm(world.robot)
    page = visit(world, tmp_path)
    page.wait_for('buttons', lambda buttons: reasons(buttons).get(RAISE) == '')
    page.ask('save', name=' Rest ')
    told = page.wait_for('buttons', lambda buttons: 'pose/Rest' in reasons(buttons))
    assert told['buttons'][-1]['isSaved'] and not told['buttons'][-1]['why']
    saved = (tmp_path / 'joint_state_publisher_gui' / 'arm.yaml').read_text()
    assert saved == 'Rest:\n  elbow: 0.1\n'
    page.ask('delete', button=RAISE)
    page.wait_for('refusal', lambda refusal: 'pose no longer exists' in refusal)
    page.told.clear()
    page.ask('delete', button='pose/Rest')
    page.wait_for('buttons', lambda buttons: set(reasons(buttons)) == {RAISE, BOW})


def test_a_file_that_is_wrong(world: LiveWorld, tmp_path: Path) -> None:
    """The page shows the sentence instead of buttons."""
    (tmp_path / 'gestures.yaml').write_text('gestures: {Wave: {}}')
    told = visit(world, tmp_path).wait_for('problem')
    assert "gestures.yaml:1: The gesture 'Wave' needs 'steps'" in told['problem']

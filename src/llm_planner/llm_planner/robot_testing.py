# SPDX-License-Identifier: Apache-2.0
"""Fake robot with scripted servers, for tests of the planner and the executor."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from control_msgs.action import FollowJointTrajectory, PointHead
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import TransformStamped
from humanoid_common.qos import EVENT, LATCHED, STATE
from humanoid_common.single_goal import GoalAborted, RunningGoal, SingleGoal
from humanoid_interfaces.action import Pick, Place, ScanRoom
from humanoid_interfaces.msg import Plan
from humanoid_interfaces.srv import FindObjects
from nav2_msgs.action import ComputePathToPose, NavigateToPose, Spin
from rclpy.node import Node
from std_msgs.msg import String
from tf2_ros import StaticTransformBroadcaster
from vision_msgs.msg import Detection3D, Detection3DArray, ObjectHypothesisWithPose

__all__ = ['MUGS', 'PLACES', 'RobotStub', 'detection']

_SEEING_TICKS = 10
PLACES = """
surfaces:
  - {name: desk, height: 0.7, outline: [[3.0, 1.0], [4.0, 1.0], [4.0, 1.6], [3.0, 1.6]]}
  - {name: shelf, height: 0.9, outline: [[-1.8, -1.8], [-0.8, -1.8], [-0.8, -1.5], [-1.8, -1.5]]}
rooms:
  - {name: hall, outline: [[-2, -2], [2, -2], [2, 2], [-2, 2]]}
  - {name: study, outline: [[2, -2], [6, -2], [6, 2], [2, 2]]}
"""


def detection(name: str, *classes: str, at: tuple[float, float, float]) -> Detection3D:
    """
    Build a remembered object.

    Parameters
    ----------
    name, classes
        Its id, its class, and its further names: `mug`, `red mug`.
    at
        Its position in the map; m.

    """
    found = Detection3D(id=name)
    for each in classes:
        result = ObjectHypothesisWithPose()
        result.hypothesis.class_id = each
        found.results.append(result)
    centre = found.bbox.center.position
    centre.x, centre.y, centre.z = at
    found.bbox.size.x = found.bbox.size.y = found.bbox.size.z = 0.1
    return found


MUGS = [
    detection('red_mug_1', 'mug', 'red mug', at=(3.2, 1.2, 0.75)),
    detection('blue_mug_1', 'mug', 'blue mug', at=(3.4, 1.2, 0.75)),
    detection('box_1', 'box', at=(0.5, 0.5, 0.05)),
]


class RobotStub(Node):
    """
    Fake robot: navigation that does not move, scripted perception, and a record of messages.

    Attributes
    ----------
    walks, spins, looks, scans, said, plans, grammars, statuses
        The goals and messages received so far.
    is_slow
        Whether a walk continues until it is canceled.
    is_hemmed_in, is_stiff
        Whether a turn would collide, and whether the head cannot be turned.
    failure, failures
        The reasons why walks fail: first those of the list in order, then always the single one.
    after_walk, after_scan
        The objects remembered after the next walk, and after the next scan, if they change.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('robot', **options)
        self.walks: list[Any] = []
        self.spins: list[float] = []
        self.looks: list[Any] = []
        self.said: list[str] = []
        self.plans: list[Plan] = []
        self.grammars: list[str] = []
        self.statuses: dict[str, DiagnosticStatus] = {}
        self.scans = self.cancelled = 0
        self.is_slow = self.is_hemmed_in = self.is_stiff = False
        self.failure = ''
        self.failures: list[str] = []
        self.after_walk: list[Detection3D] | None = None
        self.after_scan: list[Detection3D] | None = None
        self._goals = SingleGoal(self, lambda: '')
        self._spins = SingleGoal(self, lambda: '')
        self._paths = SingleGoal(self, lambda: '')
        self._scans = SingleGoal(self, lambda: '')
        self._scans.offer(ScanRoom, 'scan_room', self._scan)
        self._looks = SingleGoal(self, lambda: '')
        self._looks.offer(PointHead, 'look_at', self._look)
        self._goals.offer(NavigateToPose, 'navigate_to_pose', self._walk)
        self._spins.offer(Spin, 'spin', self._spin)
        self._paths.offer(ComputePathToPose, 'compute_path_to_pose', self._path)
        self.create_service(FindObjects, 'find_objects', lambda _, response: response)
        self.create_subscription(String, 'speech/say', self._hear, EVENT)
        self.create_subscription(Plan, 'plan', self.plans.append, LATCHED)
        self.create_subscription(DiagnosticArray, 'diagnostics', self._diagnose, STATE)
        self.create_subscription(
            String, 'speech/grammar', lambda message: self.grammars.append(message.data), LATCHED
        )
        self.commands = self.create_publisher(String, 'user_command', EVENT)
        self.transcripts = self.create_publisher(String, 'speech/transcript', EVENT)
        self.walking = self.create_publisher(String, 'walking_state', LATCHED)
        self.objects = self.create_publisher(Detection3DArray, 'objects', LATCHED)
        self._transforms = StaticTransformBroadcaster(self)
        self.move_to(0.0, 0.0)
        self.remember(MUGS)

    def give_hands(self) -> None:
        """
        Offer the actions of the hands and the arms from now on.

        `held` are the objects in the right hand, `placed` those put down, and `moved` the sides of
        the arms that moved.
        """
        self.held: list[Detection3D] = []
        self.placed: list[tuple[str, str]] = []
        self.too_wide: set[str] = set()
        self._arms: list[SingleGoal] = []
        self.holding = self.create_publisher(Detection3DArray, 'held_objects', LATCHED)
        self._hands = SingleGoal(self, lambda: '')
        self._hands.offer(Pick, 'pick', self._pick)
        self._hands.offer(Place, 'place', self._place)
        self.moved: list[str] = []
        for side in ('left', 'right'):
            self._arms.append(SingleGoal(self, lambda: ''))
            action = f'{side}_arm_controller/follow_joint_trajectory'
            self._arms[-1].offer(FollowJointTrajectory, action, self._move_arm)

    async def _pick(self, goal: RunningGoal) -> None:
        name = goal.request.object
        if name in self.too_wide:
            raise GoalAborted('NOT_REACHABLE', f'{name} is too wide for my hand.')
        self.held = [each for each in self._remembered if each.id == name]
        for each in self.held:
            each.header.frame_id = 'r_gripper'
        await self._tell_hands(goal)

    async def _move_arm(self, goal: RunningGoal) -> None:
        self.moved.append(goal.request.trajectory.joint_names[0].partition('_')[0])

    async def _place(self, goal: RunningGoal) -> None:
        self.placed += [(each.id, goal.request.place) for each in self.held]
        self.held = []
        await self._tell_hands(goal)

    async def _tell_hands(self, goal: RunningGoal) -> None:
        """Publish the held objects, which are no longer among the remembered ones."""
        self.holding.publish(Detection3DArray(detections=self.held))
        gone = {each.id for each in self.held} | {name for name, _ in self.placed}
        await self._see(goal, [each for each in self._remembered if each.id not in gone])

    def move_to(self, x_m: float, y_m: float) -> None:
        """
        Publish a pose of the robot in the map, with a yaw of zero.

        Parameters
        ----------
        x_m, y_m
            The position of `base_footprint` in the map frame.

        """
        here = TransformStamped(child_frame_id='base_footprint')
        here.header.frame_id = 'map'
        here.transform.translation.x, here.transform.translation.y = x_m, y_m
        here.transform.rotation.w = 1.0
        self._transforms.sendTransform(here)

    def remember(self, things: Sequence[Detection3D]) -> None:
        """
        Publish remembered objects on `objects`.

        Parameters
        ----------
        things
            All objects; previous ones are forgotten.

        """
        self._remembered = list(things)
        self.objects.publish(Detection3DArray(detections=things))

    def heard(self, *texts: str) -> Callable[[], bool]:
        """
        Build a predicate that checks whether some texts were spoken, in order.

        Parameters
        ----------
        *texts
            Parts of utterances, each of a separate one.

        Returns
        -------
        Callable
            The predicate, for everything spoken since the node was created.

        """

        def were_said() -> bool:
            said = iter(self.said)
            return all(any(text in each for each in said) for text in texts)

        return were_said

    def _diagnose(self, message: DiagnosticArray) -> None:
        self.statuses |= {each.name: each for each in message.status}

    def _hear(self, message: String) -> None:
        self.said.append(message.data)

    async def _walk(self, goal: RunningGoal) -> None:
        self.walks.append(goal.request.pose.pose.position)
        try:
            while self.is_slow:
                await goal.tick()
        except BaseException:
            self.cancelled += 1
            raise
        seen, self.after_walk = self.after_walk, None
        await self._see(goal, seen)
        if failure := self.failures.pop(0) if self.failures else self.failure:
            raise GoalAborted('UNKNOWN', failure)

    async def _scan(self, goal: RunningGoal) -> None:
        self.scans += 1
        seen, self.after_scan = self.after_scan, None
        await self._see(goal, seen)

    async def _look(self, goal: RunningGoal) -> None:
        self.looks.append(goal.request.target.point)
        if self.is_stiff:
            raise GoalAborted('UNKNOWN', '')

    async def _see(self, goal: RunningGoal, things: Sequence[Detection3D] | None) -> None:
        """Publish other objects if given, and leave all nodes time to receive them."""
        if things is not None:
            self.remember(things)
            for _ in range(_SEEING_TICKS):
                await goal.tick()

    async def _spin(self, goal: RunningGoal) -> None:
        self.spins.append(goal.request.target_yaw)
        if self.is_hemmed_in:
            raise GoalAborted('COLLISION_AHEAD', "'spin' would collide in 0.2 s.")

    async def _path(self, goal: RunningGoal) -> None:
        if goal.request.goal.pose.position.x > 5.5:
            raise GoalAborted('UNKNOWN', 'There is a wall.')

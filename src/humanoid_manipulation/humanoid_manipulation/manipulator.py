# SPDX-License-Identifier: Apache-2.0
"""The node `manipulator`: the actions `reach`, `pick`, `place`, `hand_over` and `drop`."""

from __future__ import annotations

import math
import sys
from typing import Any

from geometry_msgs.msg import PoseStamped
from humanoid_common.inhibition import Inhibition
from humanoid_common.qos import LATCHED
from humanoid_common.running import run_node
from humanoid_common.single_goal import GoalAborted, RunningGoal, SingleGoal
from humanoid_control.dynamics.frames import Frame
from humanoid_description.drives import SIDES
from humanoid_description.rotations import from_quaternion, quaternion_of
from humanoid_interfaces.action import Drop, HandOver, Pick, Place
from humanoid_interfaces.action import Reach as ReachAction
from humanoid_manipulation.arm_trajectory import timed
from humanoid_manipulation.errors import ManipulationError
from humanoid_manipulation.giving import Giving
from humanoid_manipulation.handling import unsound_side
from humanoid_manipulation.manipulation_node import ManipulationNode
from humanoid_manipulation.motion_planning import approach, BlockedError, plan
from humanoid_manipulation.picking import Picking
from humanoid_manipulation.placing import Placing
from humanoid_manipulation.upper_body import OutOfReachError, Reach
import numpy as np
from std_msgs.msg import String

__all__ = ['Manipulator', 'main']

_LONGEST_APPROACH_M = 0.3


class Manipulator(ManipulationNode):
    """
    Action server that moves the arms and manipulates objects.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__(**options)
        self._inhibition = Inhibition()
        self.goals = SingleGoal(self, lambda: self._inhibition.reason)
        picking, placing, giving = Picking(self), Placing(self), Giving(self)
        self.goals.offer(ReachAction, 'reach', self._reach, _unsound)
        self.goals.offer(Pick, 'pick', picking.work, picking.unsound)
        self.goals.offer(Place, 'place', placing.work, placing.unsound)
        self.goals.offer(HandOver, 'hand_over', giving.hand_over, giving.unsound)
        self.goals.offer(Drop, 'drop', giving.drop, giving.unsound)
        for topic, take in (
            ('walking_state', self._inhibition.tell_walking_state),
            ('stop_state', self._inhibition.tell_stop_state),
        ):
            self.create_subscription(
                String, topic, lambda message, tell=take: tell(message.data), LATCHED
            )

    async def _reach(self, goal: RunningGoal) -> None:
        with self.transforms.listening(), self.arms.listening():
            await self.arms.wait(goal)
            told, request = self.parameters.current, goal.request
            wanted = _frame(request.pose)
            seen = await self.transforms.known(
                goal, told.base_frame, request.pose.header.frame_id or told.base_frame
            )
            wanted = Frame(
                seen[:3, :3] @ wanted.position_m + seen[:3, 3], seen[:3, :3] @ wanted.rotation
            )
            try:
                side, way = await self._way(goal, wanted)
                goal.result.side = side
                await self.arms.move(
                    goal,
                    side,
                    timed(way, told.max_velocity),
                    lambda: goal.publish_feedback(
                        ReachAction.Feedback(distance=self._away_m(side, wanted))
                    ),
                )
            except OutOfReachError as error:
                _fill_pose(goal.result.reached, told.base_frame, error.pose)
                raise GoalAborted('NOT_REACHABLE', str(error)) from None
            except BlockedError as error:
                raise GoalAborted('BLOCKED', str(error)) from None
            except ManipulationError as error:
                raise GoalAborted('INVALID', str(error)) from None
            await goal.tick()
            reached = self.arms.body.forward(side, self.arms.reach_of(side))
            _fill_pose(goal.result.reached, told.base_frame, reached)

    def _away_m(self, side: str, wanted: Frame) -> float:
        """Compute the distance of a gripper from its target pose in the pelvis frame."""
        here = self.arms.body.forward(side, self.arms.reach_of(side)).position_m
        return float(np.linalg.norm(here - wanted.position_m))

    async def _way(self, goal: RunningGoal, wanted: Frame) -> tuple[str, list[Reach]]:
        """Plan a path to a pose for the first arm that reaches it; return its side and path."""
        told, request, body = self.parameters.current, goal.request, self.arms.body
        obstacles = await self.surroundings.obstacles(goal)
        # The z axis of the gripper points along the hand, back to the wrist.
        back = wanted.rotation[:, 2] * float(request.approach)
        first = Frame(wanted.position_m + back, wanted.rotation)
        sides = [request.side] if request.side else _nearest_first(wanted)
        error: ManipulationError | None = None
        for side in sides:
            start = self.arms.reach_of(side)
            # One world per side: it keeps the posture in which an arm was checked last.
            world = self.arms.world(obstacles, self.held.boxes, told.clearance)
            try:
                begin = body.reach(side, first, start)
                straight = approach(body, side, begin, -back) if request.approach else []
                way = plan(world, side, start, begin)
                for each in straight:
                    for contact in world.contacts(side, each):
                        raise BlockedError(f'The {side} arm cannot go straight there: {contact}.')
                return side, [*way, *straight[1:]]
            except ManipulationError as reason:
                error = error or reason
        assert error is not None
        raise error


def _nearest_first(wanted: Frame) -> tuple[str, ...]:
    """Return both sides, starting with the side that a pose is on."""
    return SIDES if wanted.position_m[1] >= 0.0 else SIDES[::-1]


def _frame(pose: PoseStamped) -> Frame:
    """Convert a pose message to a `Frame`."""
    at, turn = pose.pose.position, pose.pose.orientation
    return Frame(np.array([at.x, at.y, at.z]), from_quaternion((turn.w, turn.x, turn.y, turn.z)))


def _unsound(request: ReachAction.Goal) -> str:
    """Validate a goal of `reach`; return the rejection message, or an empty string."""
    at, turn = request.pose.pose.position, request.pose.pose.orientation
    numbers = (at.x, at.y, at.z, turn.x, turn.y, turn.z, turn.w)
    if not all(map(math.isfinite, numbers)):
        return 'Its pose has a value that is not finite.'
    if not 0.5 < math.hypot(*numbers[3:]) < 2.0:
        return 'The orientation of its pose is not a unit quaternion.'
    if reason := unsound_side(request.side):
        return reason
    if not 0.0 <= request.approach <= _LONGEST_APPROACH_M:
        return f'Its approach is {request.approach:g} m. Give 0 to {_LONGEST_APPROACH_M:g} m.'
    return ''


def _fill_pose(message: PoseStamped, name: str, frame: Frame) -> None:
    """Fill in a pose message, with the name of its frame."""
    message.header.frame_id = name
    position, orientation = message.pose.position, message.pose.orientation
    position.x, position.y, position.z = frame.position_m.tolist()
    orientation.w, orientation.x, orientation.y, orientation.z = quaternion_of(frame.rotation)


def main() -> int:
    """Run the node."""
    return run_node(Manipulator)


if __name__ == '__main__':
    sys.exit(main())

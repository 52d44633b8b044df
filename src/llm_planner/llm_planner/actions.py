# SPDX-License-Identifier: Apache-2.0
"""Start skills, and implement those that need only the arms and speech."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
import math
from operator import attrgetter
from typing import Any

from control_msgs.action import FollowJointTrajectory
from llm_planner.handling import Handling, Tidying
from llm_planner.looking import Looking
from llm_planner.plan import Step, value_in_words
from llm_planner.recall import HEAD_M, Recall
from llm_planner.robot import RobotInterface
from llm_planner.skills import SkillError, SkillRun, Skills
from llm_planner.telling import Telling
from llm_planner.walking import Walking
from llm_planner.world import ObjectDescription
from llm_planner.world_watch import WorldWatch
from rclpy.duration import Duration
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

__all__ = ['Actions']

_METHODS: Mapping[str, str] = {
    **{name: f'_walking.{name}' for name in ('come_back', 'move', 'turn', 'follow_path')},
    **{name: f'_looking.{name}' for name in ('look_at', 'look_around', 'find')},
    **{name: f'_handling.{name}' for name in ('pick', 'place', 'hand_over')},
    **{name: f'_telling.{name}' for name in ('where', 'describe', 'identify', 'tell_count')},
    'tidy': '_tidying.tidy',
    **{name: f'_{name}' for name in ('go_to', 'wave', 'point_at', 'say', 'wait', 'stop')},
}
"""The method of `Actions`, or of one of its parts, that implements each skill."""
_DOWN = (0.0, 0.1, 0.0, -0.3)
_UP, _OUT = (-1.6, 0.6, 0.0, -1.6), (-1.6, 1.0, 0.0, -1.0)


class Actions:
    """
    Dispatcher that starts the implementation of each skill.

    Parameters
    ----------
    robot, watch
        The interface to the robot, and the observed world.
    skills
        The skills, for the defaults of their arguments.

    """

    IMPLEMENTED = frozenset(_METHODS)
    """The names of the implemented skills."""

    def __init__(self, robot: RobotInterface, watch: WorldWatch, skills: Skills) -> None:
        self._robot, self._watch, self._skills = robot, watch, skills
        self._recall = Recall(watch)
        self._walking = Walking(robot, watch, self._recall)
        self._looking = Looking(robot, watch, self._recall, self._walking)
        self._telling = Telling(robot, watch, self._recall, self._walking, self._looking)
        self._handling = Handling(robot, watch, self._recall)
        self._tidying = Tidying(robot, watch, self._walking, self._looking, self._handling)

    def begin_plan(self) -> None:
        """Store the pose to come back to, and forget the objects found by the previous plan."""
        self._recall.begin_plan()
        self._walking.begin_plan()

    def start(self, step: Step) -> SkillRun:
        """
        Start the skill of a plan step.

        The announcement of the skill is spoken immediately; everything else happens while the
        result is iterated.

        Parameters
        ----------
        step
            A validated step. Omitted arguments get the defaults of the skill.

        Returns
        -------
        SkillRun
            The running skill: advance it once per tick, and close it to cancel.

        """
        skill = self._skills[step.skill]
        arguments = {name: each.default for name, each in skill.arguments.items()}
        arguments.update(step.arguments)
        said = {
            name: value_in_words(value, skill.arguments[name])
            for name, value in arguments.items()
            if value not in (None, '')
        }
        if skill.says:
            self._robot.say(skill.says.format_map(said))
        run: SkillRun = attrgetter(_METHODS[step.skill])(self)(**arguments)
        return run

    def _stop(self) -> SkillRun:
        return
        yield

    def _go_to(self, target: Any) -> SkillRun:
        yield from self._walking.go_to(target)
        if isinstance(target, ObjectDescription):
            yield from self._looking.glance_at(self._recall.position(target))
            self._recall.thing(target)  # raises if the robot has seen that it is gone

    def _say(self, text: str) -> SkillRun:
        self._robot.say(text)
        return
        yield

    def _wait(self, duration: float) -> SkillRun:
        yield from self._robot.sleep(duration)

    def _wave(self, arm: str) -> SkillRun:
        side = self._free_arm('right') if arm == 'free' else arm
        held = self._watch.held_by(side)
        if held:
            raise SkillError(
                f'I cannot wave: my {side} hand is holding the {held}.', is_final=True
            )
        yield from self._move_arm(side, [_UP, _OUT, _UP, _OUT, _UP, _DOWN])

    def _point_at(self, target: Any) -> SkillRun:
        position_m = self._recall.position(target)
        yield from self._walking.face(position_m)
        point = self._watch.point_from_robot(position_m)
        if point is None:
            raise SkillError('I do not know where I am, so I cannot point at anything.')
        x, y, z = point
        side = self._free_arm('left' if y >= 0.0 else 'right')
        sign = 1.0 if side == 'left' else -1.0
        yield from self._looking.glance_at(position_m)
        y, z = y - sign * 0.2, z - HEAD_M
        length = math.sqrt(x * x + y * y + z * z) or 1.0
        # At zero the upper arm hangs down; the shoulder rotates it about y, then about x.
        pitch, roll = math.atan2(-x, -z), sign * math.asin(max(-1.0, min(1.0, y / length)))
        pointing = (max(-2.6, min(0.5, pitch)), max(-0.2, min(1.5, roll)), 0.0, 0.0)
        yield from self._move_arm(side, [pointing, pointing, pointing, _DOWN])

    def _free_arm(self, preferred: str) -> str:
        """Return the side of an arm with an empty hand, the preferred one if possible."""
        other = 'left' if preferred == 'right' else 'right'
        free = [side for side in (preferred, other) if not self._watch.held_by(side)]
        if not free:
            raise SkillError('Both my hands are full.', is_final=True)
        return free[0]

    def _move_arm(self, side: str, postures: Sequence[Sequence[float]]) -> SkillRun:
        """Move an arm through postures given for the left arm; the right arm mirrors them."""
        mirror = (1.0, -1.0, -1.0, 1.0) if side == 'right' else (1.0, 1.0, 1.0, 1.0)
        names = self._watch.arm_joints(side)
        level = [0.0] * (len(names) - len(mirror))
        points = [
            JointTrajectoryPoint(
                positions=[*(factor * at for factor, at in zip(mirror, posture)), *level],
                time_from_start=Duration(seconds=1.2 * number).to_msg(),
            )
            for number, posture in enumerate(postures, 1)
        ]
        trajectory = JointTrajectory(joint_names=names, points=points)
        yield from self._robot.act(
            FollowJointTrajectory,
            f'{side}_arm_controller/follow_joint_trajectory',
            FollowJointTrajectory.Goal(trajectory=trajectory),
        )

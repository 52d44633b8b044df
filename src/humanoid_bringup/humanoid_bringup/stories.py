# SPDX-License-Identifier: Apache-2.0
"""Stories: commands to a robot, with checks of their results by ground truth."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
import math
from pathlib import Path
from typing import Any

from humanoid_bringup.testing import ToldRobot
from humanoid_common.testing.waiting import WaitedInVainError
from humanoid_control.walking.planar import PlanarPose

__all__ = [
    'AS_ASKED', 'EXPLAINED', 'WRONG', 'Check', 'CheckInput', 'Play', 'Story', 'stays', 'tell_all',
]  # fmt: skip

AS_ASKED, EXPLAINED, WRONG = 'as asked', 'explained', 'WRONG'
_ANSWER_S, _PLAN_S = 60.0, 3.0


@dataclass
class CheckInput:
    """The input of a check: the robot, and its true pose before the command."""

    told: ToldRobot
    before: PlanarPose

    @property
    def said(self) -> str:
        """All that the robot has said since the command."""
        return ' '.join(self.told.said)

    @property
    def turned_deg(self) -> float:
        """Return the true rotation of the robot since the command, positive to the left."""
        turn = self.told.robot.pose.yaw_rad - self.before.yaw_rad
        return math.degrees(math.remainder(turn, math.tau))

    @property
    def moved_m(self) -> complex:
        """Return the true displacement since the command: x along the old heading, y leftwards."""
        way = self.told.robot.pose.position_m - self.before.position_m
        return way * complex(math.cos(self.before.yaw_rad), -math.sin(self.before.yaw_rad))


Check = Callable[[CheckInput], bool]
Play = Callable[[ToldRobot], None]


@dataclass(frozen=True)
class Story:
    """A command of a kind, the check of its result, and, if it is spoken, the WAV file."""

    kind: str
    command: str
    check: Check
    wav: Path | None = None
    play: Play = lambda told: None
    """Called after the command, to act on the robot or its world."""

    within_s: float = 600.0
    """Timeout of each plan, in s of real time."""


def stays(text: str) -> Check:
    """
    Build the check that the robot says something but does not move.

    Parameters
    ----------
    text
        A part of what it must say.

    Returns
    -------
    Check
        Holds if the robot has also walked less than 0.1 m and turned by less than 5 degrees.

    """
    return lambda scene: (
        text in scene.said and abs(scene.moved_m) < 0.1 and abs(scene.turned_deg) < 5.0
    )


def tell_all(told: ToldRobot, stories: Sequence[Story], capsys: Any) -> list[str]:
    """
    Run one story after another, print a table row for each, and return their results.

    Parameters
    ----------
    told, stories
        The robot, and the stories to run.
    capsys
        The fixture of the test; it is disabled while rows are printed.

    """
    ends = []
    for number, story in enumerate(stories, 1):
        begin_s = told.robot.topics.time_s
        ends.append(_tell(told, story))
        took_s = told.robot.topics.time_s - begin_s
        how = 'spoken' if story.wav else 'typed'
        with capsys.disabled():
            print(
                f'\n| {number} | {story.kind} | {story.command} ({how}) | {ends[-1]} | '
                f'{took_s:.0f} s | {" ".join(told.said)} |',
                end='',
                flush=True,
            )
    return ends


def _tell(told: ToldRobot, story: Story) -> str:
    """Run a story, and return its result."""
    told.forget()
    scene = CheckInput(told, told.robot.pose)
    try:
        if story.wav:
            told.speak(story.wav)
        else:
            told.tell(story.command)
        story.play(told)
        told.wait_until(lambda: bool(told.said or told.plan), _ANSWER_S, 'an answer')
        told.robot.wait(_PLAN_S)  # a mere answer has no plan
        if told.plan is not None:
            told.wait_for_the_end(story.within_s)
    except WaitedInVainError:
        told.tell('stop')
        told.wait_for('I have stopped.', _ANSWER_S)
        return WRONG
    if story.check(scene):
        return AS_ASKED
    if told.said and not told.has_succeeded:
        return EXPLAINED
    return f'{WRONG}: moved by {scene.moved_m:.2f} m, turned by {scene.turned_deg:.0f} degrees'

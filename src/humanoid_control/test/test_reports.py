# SPDX-License-Identifier: Apache-2.0
"""Check what is said of falls and of obstacles."""

from __future__ import annotations

from humanoid_control.hosting.reports import FallReport, ObstacleReport


class Paper:
    """A log that keeps what it is told."""

    def __init__(self) -> None:
        """Begin empty."""
        self.errors: list[str] = []
        self.warnings: list[str] = []
        self.news: list[str] = []

    def error(self, message: str) -> None:
        """Keep what is bad."""
        self.errors.append(message)

    def warning(self, message: str) -> None:
        """Keep what is in the way."""
        self.warnings.append(message)

    def info(self, message: str) -> None:
        """Keep what is good."""
        self.news.append(message)


def test_a_fall_is_said_once() -> None:
    """However long the robot lies there, it is said once, with what to do, and so is its end."""
    paper = Paper()
    report = FallReport(paper, 'robot1')
    for is_down in (False, True, True, False, False):
        report.look(is_down)
    assert len(paper.errors) == len(paper.news) == 1
    assert paper.errors[0].startswith("The robot 'robot1' has fallen")
    assert "'stand_up'" in paper.errors[0]
    assert paper.news == ["The robot 'robot1' stands again."]


def test_giving_up_is_said_once() -> None:
    """A robot that has given up getting up says what to do."""
    paper = Paper()
    report = FallReport(paper, 'robot1')
    for has_given_up in (False, True, True):
        report.look(True, has_given_up)
    assert len(paper.errors) == 2
    assert paper.errors[1].startswith("The robot 'robot1' has not managed to get up")


def test_the_only_robot_has_no_name() -> None:
    """A robot without a name is just the robot."""
    paper = Paper()
    FallReport(paper, '').look(True)
    assert paper.errors[0].startswith('The robot has fallen')


def test_an_obstacle_is_said_once_each_time() -> None:
    """However long it is in the way, it is said once; when it is met again, again."""
    paper = Paper()
    report = ObstacleReport(paper, 'robot1')
    for is_blocked in (False, True, True, False, True):
        report.look(is_blocked)
    assert len(paper.warnings) == 2
    assert paper.warnings[0].startswith("The robot 'robot1' is blocked. Something is in the way")

# SPDX-License-Identifier: Apache-2.0
"""Check what is said of falls."""

from __future__ import annotations

from humanoid_control.hosting.fall_report import FallReport


class Paper:
    """A log that keeps what it is told."""

    def __init__(self) -> None:
        """Begin empty."""
        self.errors: list[str] = []
        self.news: list[str] = []

    def error(self, message: str) -> None:
        """Keep what is bad."""
        self.errors.append(message)

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


def test_the_only_robot_has_no_name() -> None:
    """A robot without a name is just the robot."""
    paper = Paper()
    FallReport(paper, '').look(True)
    assert paper.errors[0].startswith('The robot has fallen')

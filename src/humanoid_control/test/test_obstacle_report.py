# SPDX-License-Identifier: Apache-2.0
"""Check what is said of obstacles."""

from __future__ import annotations

from humanoid_control.hosting.obstacle_report import ObstacleReport


class Paper:
    """A log that keeps what it is told."""

    def __init__(self) -> None:
        """Begin empty."""
        self.warnings: list[str] = []

    def warning(self, message: str) -> None:
        """Keep it."""
        self.warnings.append(message)


def test_an_obstacle_is_said_once_each_time() -> None:
    """However long it is in the way, it is said once; when it is met again, again."""
    paper = Paper()
    report = ObstacleReport(paper, 'robot1')
    for is_blocked in (False, True, True, False, True):
        report.look(is_blocked)
    assert len(paper.warnings) == 2
    assert paper.warnings[0].startswith("The robot 'robot1' is blocked. Something is in the way")

# SPDX-License-Identifier: Apache-2.0
"""Which recorded topics would move a robot, or lie about a live one, if they were played."""

from __future__ import annotations

from collections.abc import Iterable
from fnmatch import fnmatchcase

__all__ = ['COMMANDS', 'commands_among']

COMMANDS = (
    'cmd_vel* *_command *_commands *command/* command commands emergency_stop '
    'console_heartbeat goal_pose initialpose clicked_point joint_trajectory */joint_trajectory '
    'goal *_goal *_cmd stop_state'
)
"""Patterns of names, without the namespace, of topics that robots obey, or answer stops on."""


def commands_among(topics: Iterable[str], patterns: str = COMMANDS) -> list[str]:
    """
    Select the topics that a robot would obey if they were played.

    Parameters
    ----------
    topics
        The names of recorded topics.
    patterns
        Shell patterns with blanks between them. One of them must match the name, or what follows
        one of its slashes, to its end.

    """
    words = patterns.split()
    return [topic for topic in topics if _fits(topic.strip('/').split('/'), words)]


def _fits(names: list[str], patterns: list[str]) -> bool:
    endings = ['/'.join(names[start:]) for start in range(len(names))]
    return any(fnmatchcase(ending, pattern) for ending in endings for pattern in patterns)

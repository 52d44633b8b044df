# SPDX-License-Identifier: Apache-2.0
"""Selection of recorded topics that would move a robot or conflict with a live one if played."""

from __future__ import annotations

from collections.abc import Iterable
from fnmatch import fnmatchcase

__all__ = ['COMMANDS', 'commands_among']

COMMANDS = (
    'cmd_vel* *_command *_commands *command/* command commands emergency_stop '
    'console_heartbeat goal_pose initialpose clicked_point joint_trajectory */joint_trajectory '
    'goal *_goal *_cmd stop_state'
)
"""Name patterns, without namespace, of topics that command robots or report their stop state."""


def commands_among(topics: Iterable[str], patterns: str = COMMANDS) -> list[str]:
    """
    Select the topics that would command a robot if they were played.

    Parameters
    ----------
    topics
        The names of recorded topics.
    patterns
        Shell patterns separated by spaces. A topic is selected if a pattern matches its full name,
        or the part after one of its slashes.

    """
    words = patterns.split()
    return [topic for topic in topics if _fits(topic.strip('/').split('/'), words)]


def _fits(names: list[str], patterns: list[str]) -> bool:
    endings = ['/'.join(names[start:]) for start in range(len(names))]
    return any(fnmatchcase(ending, pattern) for ending in endings for pattern in patterns)

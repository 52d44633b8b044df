# SPDX-License-Identifier: Apache-2.0
"""The global options, and the global status: whether transforms reach the fixed frame."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
import re
from typing import TYPE_CHECKING

from rviz_common.properties import Choice, ColorOf, Flag, Number, Text
from rviz_common.status import Level, Statuses

if TYPE_CHECKING:
    from rclpy.node import Node
    from rviz_common.frames import Frames

__all__ = [
    'BACKGROUND',
    'FIXED_FRAME',
    'FRAME_RATE',
    'GROUND',
    'OPTIONS',
    'THEME',
    'UNUSED_OPTIONS',
    'FrameWatch',
]

BACKGROUND, FIXED_FRAME, FRAME_RATE = 'Background Color', 'Fixed Frame', 'Frame Rate'
GROUND, THEME = 'Ground and Sky', 'Theme'
OPTIONS = (
    ColorOf(BACKGROUND, (48, 48, 48), 'The background color.'),
    Text(FIXED_FRAME, 'map', 'The frame that stays fixed on the screen.'),
    Number(FRAME_RATE, 30.0, 'Maximum number of frames drawn per second; at most 60.', 1),
    Flag(
        GROUND,
        False,
        'Instead of the background, draw the ground at z = 0 of the fixed frame, a soft shadow '
        'below each robot, and a sky.',
    ),
    Choice(
        THEME,
        'Browser',
        'The theme of the page; Browser: that of the system. Each browser can choose another one.',
        ('Browser', 'Dark', 'Light'),
    ),
)
UNUSED_OPTIONS = ('Default Light',)

SUBJECT = 'Fixed Frame'
TOPICS = ('/tf', '/tf_static')
PARENT = re.compile(r'^Frame (.*) exists with parent (.*)\.$', re.MULTILINE)
NO_PARENT = 'NO_PARENT'
SHOWN = 4


class FrameWatch:
    """
    Reports whether frames can be placed in the fixed frame, and which transforms are missing.

    Parameters
    ----------
    node
        Counts the publishers of transforms.
    frames
        The transforms, and the fixed frame.
    status
        Receives the message, with the subject `Fixed Frame`.

    """

    def __init__(self, node: Node, frames: Frames, status: Statuses) -> None:
        self._node = node
        self._frames = frames
        self._status = status

    def update(self) -> None:
        """Update the status from the current transforms."""
        level, sentence = self._judge()
        self._status.say(SUBJECT, level, sentence)

    def names(self) -> list[str]:
        """Return the names of all known frames."""
        return sorted(self._frames.buffer.known_frames.names())

    def _judge(self) -> tuple[Level, str]:
        fixed, names = self._frames.fixed_frame, self.names()
        if not fixed:
            return Level.ERROR, 'No fixed frame selected. Select one in the options above.'
        if not names:
            return self._of_silence()
        if fixed not in names:
            return Level.ERROR, _unknown(fixed, names)
        return self._of_trees(fixed, names)

    def _of_silence(self) -> tuple[Level, str]:
        """Explain why there are no frames at all."""
        talking = [topic for topic in TOPICS if self._node.count_publishers(topic)]
        fixed = self._frames.fixed_frame
        if not talking:
            return Level.WARN, (
                f"No publisher on {' or '.join(TOPICS)}: only data in '{fixed}' itself can be "
                'shown. Start robot_state_publisher, or another publisher of the robot pose.'
            )
        return Level.WARN, (
            f'There is a publisher of {" and ".join(talking)}, but no transform received yet.'
        )

    def _of_trees(self, fixed: str, names: list[str]) -> tuple[Level, str]:
        """Report the frames that no transform connects to the fixed frame."""
        parents = dict(PARENT.findall(self._frames.buffer.all_frames_as_string()))
        tops = _tops(names, parents)
        roots = Counter(tops[name] for name in names)
        own = tops[fixed]
        connected = roots.pop(own)
        if not roots:
            return Level.OK, f'{connected} frames are connected.'
        others = ', '.join(
            f"'{root}' and the {count - 1} below it" if count > 1 else f"'{root}'"
            for root, count in sorted(roots.items())[:SHOWN]
        )
        return Level.WARN, (
            f"No transform from '{fixed}' to {others}: nothing connects '{own}' and "
            f"'{sorted(roots)[0]}', so data in those frames cannot be shown."
        )


def _tops(names: Iterable[str], parents: Mapping[str, str]) -> dict[str, str]:
    """
    Return the root of each frame, in time linear in the number of frames.

    For frames in a loop it is the frame at which the way up would close the loop.
    """
    tops: dict[str, str] = {}
    for name in names:
        way = {name: None}  # in the order of traversal
        while name not in tops:
            above = parents.get(name, NO_PARENT)
            if above == NO_PARENT or above in way:
                tops[name] = name
            else:
                name = above
                way[name] = None
        tops.update(dict.fromkeys(way, tops[name]))
    return tops


def _unknown(fixed: str, names: list[str]) -> str:
    """Report an unknown fixed frame, and list the known frames."""
    from ros_environment.suggestions import did_you_mean

    meant = did_you_mean(fixed, names)
    listed = ', '.join(names[:SHOWN]) + (', ...' if len(names) > SHOWN else '')
    hint = f' {meant}' if meant else f' The frames are: {listed}.'
    return f"There is no frame '{fixed}': no transform from or to it is published.{hint}"

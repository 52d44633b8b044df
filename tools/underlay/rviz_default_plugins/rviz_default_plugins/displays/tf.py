# SPDX-License-Identifier: Apache-2.0
"""The display of the frames of tf."""

from __future__ import annotations

from collections.abc import Mapping
import time
from typing import Any

import numpy as np
from rviz_common.display import Display
from rviz_common.properties import Flag, Number, Text
from rviz_common.status import Level
from rviz_default_plugins.decoding.geometry import FARTHEST
from rviz_default_plugins.parts import Parts
from rviz_default_plugins.tf_frames import Age, Ageing, FrameFilter, placed
from rviz_default_plugins.tf_scene import FramesScene, FrameStyle, Segments
from tf2_py.poses import Pose
from tf2_py.samples import Sample

__all__ = ['TF']

ALL_FRAMES = 'Frames/All Enabled'
MAX_FRAMES = 1000
MAX_NAMED = 10
SHORTEST_M = 1e-4
SENTENCES_S = 0.5
Poses = Mapping[str, Pose]


class TF(Display):
    """
    The axes of the frames of tf, their names, and an arrow from each one to its parent.

    Parameters
    ----------
    *arguments, **options
        As for `Display`.

    """

    CLASS = 'rviz_default_plugins/TF'
    PROPERTIES = (
        Flag('Show Names', False, 'Show the names of frames.'),
        Flag('Show Axes', True, 'Show the axes of frames.'),
        Flag('Show Arrows', True, 'Show an arrow from each frame to its parent.'),
        Number('Marker Scale', 1.0, 'Size of axes, names and arrows.', 0.0001, 1e6),
        Number('Update Interval', 0.0, 'Seconds between updates; 0: each frame.', 0.0),
        Number(
            'Frame Timeout',
            15.0,
            'Seconds without updates after which a frame disappears; it turns grey before.',
            1.0,
        ),
        Text('Filter (whitelist)', '', 'Show only frames that match this regular expression.'),
        Text('Filter (blacklist)', '', 'Hide frames that match this regular expression.'),
        Flag(ALL_FRAMES, True, 'Show frames that the file does not mention.'),
    )
    UNUSED = ('Tree',)

    def __init__(self, *arguments: Any, **options: Any) -> None:
        super().__init__(*arguments, **options)
        self._frames = Parts(super().to_file().get('Frames'))
        self._frames.all_shown = self.values[ALL_FRAMES]
        self._ageing = Ageing()

    def to_file(self) -> dict[str, Any]:
        """Return the entry for the .rviz file, with the settings of single frames."""
        return self._frames.put_into(super().to_file(), 'Frames')

    def start(self) -> None:
        """Start without frames."""
        self._next_s = self._next_sentences_s = 0.0
        self._filter = self._new_filter()
        style = FrameStyle(
            self.values['Show Axes'],
            self.values['Show Names'],
            self.values['Show Arrows'],
            self.values['Marker Scale'],
        )
        self._scene = FramesScene(self.context.scene, self.root, style)

    def stop(self) -> None:
        """Remove the frames."""
        self._scene.remove()
        self.status.clear()

    def update(self) -> None:
        """Update the poses of the frames."""
        now_s = time.monotonic()
        if now_s < self._next_s:
            return
        self._next_s = now_s + self.values['Update Interval']
        samples = self.context.frames.latest()
        self._ageing.hear(samples, now_s)
        found, others = placed(samples, self.context.frames.fixed_frame)
        poses = {frame: pose for frame, pose in found.items() if _is_near(pose)}
        shown = self._shown(poses, now_s)
        old = {frame: pose for frame, pose in shown.items() if self._is_old(frame, now_s)}
        fresh = {frame: pose for frame, pose in shown.items() if frame not in old}
        self._scene.show(fresh, old, _arrows(shown, poses, samples))
        if now_s >= self._next_sentences_s:
            self._next_sentences_s = now_s + SENTENCES_S
            self._say_how_many(poses, shown)
            self._say_unconnected(others)
            self._say_far(sorted(found.keys() - poses.keys()))

    def on_change(self, path: str) -> None:
        """
        Restart; a change for all frames also overrides the settings of single ones.

        Parameters
        ----------
        path
            As for `Display.on_change`.

        """
        if path == ALL_FRAMES:
            self._frames.show_all(self.values[ALL_FRAMES])
        super().on_change(path)

    def _new_filter(self) -> FrameFilter:
        try:
            return FrameFilter(
                self.values['Filter (whitelist)'], self.values['Filter (blacklist)']
            )
        except ValueError as error:
            self.status.say('Filter', Level.ERROR, f'All frames are shown: {error}')
            return FrameFilter()

    def _shown(self, poses: Poses, now_s: float) -> dict[str, Pose]:
        timeout_s = self.values['Frame Timeout']
        found = {
            frame: pose
            for frame, pose in poses.items()
            if self._filter.shows(frame)
            and self._frames.is_shown(frame)
            and self._ageing.age(frame, now_s, timeout_s) is not Age.GONE
        }
        if len(found) <= MAX_FRAMES:
            self.status.forget('Number')
            return found
        self.status.say(
            'Number',
            Level.WARN,
            f'{len(found)} frames are too many: {MAX_FRAMES} are shown. Choose some by a filter.',
        )
        return dict(list(found.items())[:MAX_FRAMES])

    def _is_old(self, frame: str, now_s: float) -> bool:
        return self._ageing.age(frame, now_s, self.values['Frame Timeout']) is Age.OLD

    def _say_how_many(self, poses: Poses, shown: Poses) -> None:
        fixed = self.context.frames.fixed_frame
        if fixed in poses:
            sentence = f'{len(shown)} of {len(poses)} frames are shown.'
            self.status.say('Frames', Level.OK, sentence)
        else:
            self.status.say('Frames', Level.WARN, f'There is no frame [{fixed}] yet.')

    def _say_unconnected(self, others: Mapping[str, list[str]]) -> None:
        fixed = self.context.frames.fixed_frame
        sentences = [
            f'No transform from [{root}] to [{fixed}]: it is not published, so {len(frames)} '
            f'frames are not shown ({_listed(frames)}).'
            for root, frames in list(others.items())[:MAX_NAMED]
        ]
        if sentences:
            self.status.say('Transform', Level.WARN, ' '.join(sentences))
        else:
            self.status.forget('Transform')

    def _say_far(self, frames: list[str]) -> None:
        if frames:
            sentence = f'{len(frames)} frames are too far away to be shown ({_listed(frames)}).'
            self.status.say('Distance', Level.WARN, sentence)
        else:
            self.status.forget('Distance')


def _is_near(pose: Pose) -> bool:
    """Check whether a pose is within the range that a browser can draw."""
    return all(abs(part) <= FARTHEST for part in pose[:3])


def _listed(frames: list[str]) -> str:
    more = f' and {len(frames) - MAX_NAMED} more' if len(frames) > MAX_NAMED else ''
    return f'{", ".join(frames[:MAX_NAMED])}{more}'


def _arrows(shown: Poses, poses: Poses, samples: Mapping[str, Sample]) -> Segments:
    """Return an arrow from each frame to its parent, unless their origins coincide."""
    ends = [
        (pose[:3], poses[samples[frame].parent][:3])
        for frame, pose in shown.items()
        if frame in samples and samples[frame].parent in poses
    ]
    arrows: Segments = np.array(ends, np.float32).reshape(-1, 2, 3)
    lengths = np.linalg.norm(arrows[:, 1] - arrows[:, 0], axis=1)
    return np.compress(lengths > SHORTEST_M, arrows, axis=0)

# SPDX-License-Identifier: Apache-2.0
"""A display of the newest message of a topic, at the pose of the message's frame."""

from __future__ import annotations

from typing import Any

from rviz_common.frames import FrameError, Pose
from rviz_common.status import Level
from rviz_common.topic_display import TopicDisplay

__all__ = ['MessageDisplay']


class MessageDisplay(TopicDisplay):
    """
    A display of the newest message of a topic.

    However fast messages arrive, `show` is called at most once per drawn frame, with the newest.
    It must draw everything below `root`, which has the pose of the message's frame.
    """

    def start(self) -> None:
        """Subscribe to the topic."""
        self._pose = Pose()
        self._newest: Any = None
        self._shown: Any = None
        super().start()

    def stop(self) -> None:
        """Unsubscribe, and remove everything that was drawn."""
        super().stop()
        self._newest = self._shown = None

    def update(self) -> None:
        """Show the newest message, and follow its frame."""
        super().update()
        message = self._newest
        if message is None:
            return
        if message is not self._shown:
            self._shown = message
            self._show(message)
        self._follow(message.header)

    def show(self, message: Any) -> None:
        """
        Draw a message below `root`, in the frame of the message.

        Parameters
        ----------
        message
            The newest message of the topic.

        Raises
        ------
        ValueError
            The message cannot be drawn; the reason is shown in the status.

        """
        raise NotImplementedError

    def placed(self, pose: Pose) -> Pose:
        """
        Compute the pose of `root` from that of the message's frame; by default they are equal.

        Parameters
        ----------
        pose
            The latest pose of the message's frame in the fixed frame.

        Returns
        -------
        Pose
            The pose of `root` in the fixed frame.

        """
        return pose

    def take(self, message: Any) -> None:
        """
        Store a message as the newest, to be shown in the next frame.

        Parameters
        ----------
        message
            The message, with a header.

        """
        self._newest = message

    def redraw(self) -> None:
        """Show the newest message again."""
        self._shown = None

    def _show(self, message: Any) -> None:
        try:
            self.show(message)
        except ValueError as error:
            self.say_left_out(error)
            return
        self.say_shown()

    def _follow(self, header: Any) -> None:
        """Move the root to the pose of the message's frame."""
        try:
            pose = self.placed(self.context.frames.pose(header.frame_id))
        except FrameError as error:
            self.status.say('Transform', Level.ERROR, str(error))
            self._frame.visible = False
            return
        self.status.forget('Transform')
        self._frame.visible = True
        if pose != self._pose:
            self._pose = pose
            self._frame.position, self._frame.wxyz = pose

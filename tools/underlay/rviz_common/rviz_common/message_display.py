# SPDX-License-Identifier: Apache-2.0
"""A display of the newest message of a topic, at the place of the message's frame."""

from __future__ import annotations

from typing import Any, ClassVar

from rviz_common.display import Display
from rviz_common.frames import FrameError, Pose
from rviz_common.properties import qos_of
from rviz_common.status import Level

__all__ = ['MessageDisplay']


class MessageDisplay(Display):
    """
    A display of the newest message of a topic.

    However fast messages come, `show` is called at most once a frame, with the newest. All that it
    draws belongs below `root`, which has the pose of the message's frame.
    """

    MESSAGE: ClassVar[type]

    def start(self) -> None:
        """Subscribe the topic."""
        self._frame = self.context.scene.add_frame(self.root, show_axes=False)
        self._pose = Pose()
        self._newest: Any = None
        self._shown: Any = None
        self.received = 0
        self._subscription: Any = None
        topic = self.values['Topic/Value']
        if not topic:
            self.status.say('Topic', Level.WARN, 'No topic is chosen.')
            return
        try:
            self._subscription = self.context.node.create_subscription(
                self.MESSAGE, topic, self._take, qos_of(self.values)
            )
        except Exception as error:  # rclpy has no one exception for bad names
            self.status.say('Topic', Level.ERROR, f"'{topic}' cannot be subscribed: {error}")
            return
        self.status.say('Topic', Level.WARN, f'No message has come on {topic} yet.')

    def stop(self) -> None:
        """Subscribe no longer, and remove what was drawn."""
        if self._subscription is not None:
            self.context.node.destroy_subscription(self._subscription)
        self._subscription = self._newest = self._shown = None
        self._frame.remove()
        self.status.clear()

    def update(self) -> None:
        """Show the newest message, and follow its frame."""
        message = self._newest
        if message is None:
            return
        if message is not self._shown:
            self._shown = message
            self._show(message)
        self._follow(message.header)

    def show(self, message: Any) -> None:
        """Draw a message, or raise ValueError with the reason why it cannot be drawn."""
        raise NotImplementedError

    def _take(self, message: Any) -> None:
        self._newest = message
        self.received += 1

    def _show(self, message: Any) -> None:
        topic = self.values['Topic/Value']
        try:
            self.show(message)
        except ValueError as error:
            self.status.say('Message', Level.ERROR, f'A message of {topic} is left out: {error}')
            return
        self.status.forget('Message')
        self.status.say('Topic', Level.OK, f'{self.received} messages have come on {topic}.')

    def _follow(self, header: Any) -> None:
        """Move what is drawn to where the frame of the message is."""
        try:
            pose = self.context.frames.pose(header.frame_id)
        except FrameError as error:
            self.status.say('Transform', Level.ERROR, str(error))
            self._frame.visible = False
            return
        self.status.forget('Transform')
        self._frame.visible = True
        if pose != self._pose:
            self._pose = pose
            self._frame.position, self._frame.wxyz = pose

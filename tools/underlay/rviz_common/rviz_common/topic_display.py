# SPDX-License-Identifier: Apache-2.0
"""The base classes of displays of a topic, and of its newest message at the pose of its frame."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, ClassVar

from rviz_common.display import Display
from rviz_common.frames import FrameError, Pose
from rviz_common.pace import Pace
from rviz_common.properties import qos_of
from rviz_common.status import Level
from rviz_common.topics import reason_of_silence

__all__ = ['MessageDisplay', 'TopicDisplay']

LOOK_S = 1.0


class TopicDisplay(Display):
    """
    A display of the messages of a topic.

    Messages are passed to `take` as they arrive; drawing waits for `update`. While none arrives,
    the status reports the reason: no publisher, another type, or an incompatible QoS profile.
    """

    MESSAGE: ClassVar[type]

    def start(self) -> None:
        """Subscribe to the topic."""
        self._frame = self.context.scene.add_frame(self.root, show_axes=False)
        self._subscriptions: list[Any] = []
        self._silence_pace = Pace(LOOK_S)
        self.received = 0
        self._is_silent = False
        topic = self.values['Topic/Value']
        if not topic:
            self.status.say('Topic', Level.WARN, 'No topic selected.')
        elif self.subscribe(self.message_type(topic), topic, self._count):
            self._is_silent = True
            self.status.say('Topic', Level.WARN, f'No message received on {topic} yet.')

    def update(self) -> None:
        """Report why no message arrives, until the first one does."""
        topic = self.values['Topic/Value']
        if not self._is_silent or not self._silence_pace.is_due():
            return
        kind, qos = self.message_type(topic), qos_of(self.values)
        reason = reason_of_silence(self.context.node, kind, topic, qos)
        self.status.say('Topic', Level.WARN, f'No message received on {topic} yet{reason}')

    def stop(self) -> None:
        """Unsubscribe, and remove everything that was drawn."""
        for subscription in self._subscriptions:
            self.context.node.destroy_subscription(subscription)
        self._subscriptions = []
        self._frame.remove()
        self.status.clear()

    def on_change(self, path: str) -> None:
        """
        Resubscribe after a change of a topic or its QoS profile; redraw after any other change.

        Parameters
        ----------
        path
            The path of the property that has been changed.

        """
        if path.partition('/')[0].endswith('Topic'):
            super().on_change(path)
        else:
            self.redraw()

    def message_type(self, topic: str) -> type:
        """
        Find the class of the messages of a topic; by default `MESSAGE`.

        Parameters
        ----------
        topic
            The topic.

        """
        return self.MESSAGE

    def take(self, message: Any) -> None:
        """
        Store a message for the next frame.

        Parameters
        ----------
        message
            A message that has just arrived on the topic.

        """
        raise NotImplementedError

    def redraw(self) -> None:
        """Redraw everything, since a property was changed."""
        raise NotImplementedError

    def subscribe(
        self,
        kind: type,
        topic: str,
        take: Callable[[Any], None],
        path: str = 'Topic',
        **options: Any,
    ) -> bool:
        """
        Subscribe to a topic until the display stops; an error is reported in the status.

        Parameters
        ----------
        kind
            The class of the messages.
        topic
            The topic.
        take
            Called with each message, in the thread of the node.
        path
            The path of the properties with the QoS profile; also the subject in the status.
        **options
            Options of `Node.create_subscription`, such as `raw`.

        Returns
        -------
        bool
            Whether the subscription succeeded.

        """
        try:
            subscription = self.context.node.create_subscription(
                kind, topic, take, qos_of(self.values, path), **options
            )
        except Exception as error:  # rclpy has no single exception for invalid names
            self.status.say(path, Level.ERROR, f"'{topic}' cannot be subscribed: {error}")
            return False
        self._subscriptions.append(subscription)
        return True

    def say_shown(self) -> None:
        """Report in the status that a message has been shown."""
        topic = self.values['Topic/Value']
        self.status.forget('Message')
        self.status.say('Topic', Level.OK, f'{self.received} messages received on {topic}.')

    def say_left_out(self, reason: object) -> None:
        """
        Report in the status that a message cannot be shown.

        Parameters
        ----------
        reason
            The error, or its text.

        """
        topic = self.values['Topic/Value']
        self.status.say('Message', Level.ERROR, f'A message of {topic} was ignored: {reason}')

    def _count(self, message: Any) -> None:
        self.received += 1
        self._is_silent = False
        self.take(message)


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

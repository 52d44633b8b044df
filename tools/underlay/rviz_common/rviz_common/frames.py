# SPDX-License-Identifier: Apache-2.0
"""Where the frames are: their poses in the fixed frame, and the listener that receives them."""

from __future__ import annotations

from typing import NamedTuple

from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.time import Time
from rviz_common.polled_topic import WaitingGroup
from tf2_py.poses import chain, inverse
from tf2_py.poses import Pose as Numbers
from tf2_py.samples import Sample
from tf2_ros import Buffer, TransformException, TransformListener

__all__ = ['FIXED_FRAME', 'WORLD', 'FrameError', 'FrameListener', 'Frames', 'Pose']

FIXED_FRAME = '<Fixed Frame>'
"""The value of a property that stands for the current fixed frame."""
WORLD = '/world'
"""The path of the scene below which everything in the fixed frame is drawn."""

# More than robots publish between two frames; older messages are dropped.
DEPTH = 1000
MOVING = QoSProfile(depth=DEPTH)
STATIC = QoSProfile(depth=DEPTH, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Pose(NamedTuple):
    """A position in metres and a rotation as quaternion w, x, y, z, as viser expects them."""

    position: tuple[float, float, float] = (0.0, 0.0, 0.0)
    wxyz: tuple[float, float, float, float] = (1.0, 0.0, 0.0, 0.0)

    def of(self, child: Pose) -> Pose:
        """
        Compose two poses: this one, of a frame, and that of a child in the frame.

        Parameters
        ----------
        child
            The pose of the child in the frame that has this pose.

        """
        return _pose(chain(_numbers(self), _numbers(child)))

    def inverse(self) -> Pose:
        """Return the pose of the parent in this frame."""
        return _pose(inverse(_numbers(self)))


class FrameError(LookupError):
    """A pose that is unknown, with the reason."""


class Frames:
    """
    The poses of frames, from a transform buffer.

    Parameters
    ----------
    buffer
        The transforms.
    fixed_frame
        The name of the frame that does not move on the screen; it can be changed at any time.

    """

    def __init__(self, buffer: Buffer, fixed_frame: str = 'map') -> None:
        self.buffer = buffer
        self.fixed_frame = fixed_frame

    def pose(self, frame: str, stamp_ns: int = 0) -> Pose:
        """
        Look up the pose of a frame in the fixed frame.

        Parameters
        ----------
        frame
            The name of the frame, or `FIXED_FRAME`; a leading slash is dropped.
        stamp_ns
            The time in ns; 0 for the latest at which the pose is known.

        Raises
        ------
        FrameError
            No transform connects the frames at that time.

        """
        return self.between(self.fixed_frame, frame, stamp_ns)

    def between(self, target: str, source: str, stamp_ns: int = 0) -> Pose:
        """
        Look up the pose of one frame in another.

        Parameters
        ----------
        target
            The frame in which the pose is expressed.
        source
            The frame whose pose it is.
        stamp_ns
            The time in ns; 0 for the latest at which the pose is known.

        Raises
        ------
        FrameError
            No transform connects the frames at that time.

        """
        target, source = self._named(target), self._named(source)
        if target == source:
            return Pose()
        direct = None if stamp_ns else self._direct(target, source)
        if direct is not None:
            return direct
        try:
            found = self.buffer.lookup_transform(target, source, Time(nanoseconds=stamp_ns))
        except TransformException as error:
            raise FrameError(f'No transform from [{source}] to [{target}]: {error}') from error
        at, turn = found.transform.translation, found.transform.rotation
        return Pose((at.x, at.y, at.z), (turn.w, turn.x, turn.y, turn.z))

    def find(self, target: str, source: str) -> Pose | None:
        """
        Look up the latest pose of one frame in another, without a reason if it is unknown.

        Use it in each frame that is drawn: finding the reason, with `reason`, is slow.

        Parameters
        ----------
        target
            The frame in which the pose is expressed.
        source
            The frame whose pose it is.

        Returns
        -------
        Pose | None
            None if no transform connects the frames.

        """
        target, source = self._named(target), self._named(source)
        if target == source:
            return Pose()
        direct = self._direct(target, source)
        if direct is not None:
            return direct
        if not self.buffer.known_frames.has(target, source):
            return None
        try:
            return self.between(target, source)
        except FrameError:
            return None

    def reason(self, target: str, source: str) -> str:
        """
        Explain why no transform connects two frames.

        It is too slow to be called for each frame that is drawn.

        Parameters
        ----------
        target
            The frame in which a pose is wanted.
        source
            The frame whose pose is wanted.

        Returns
        -------
        str
            The error message of tf2, '' if the pose is known.

        """
        try:
            self.between(target, source)
        except FrameError as error:
            return str(error)
        return ''

    def latest(self) -> dict[str, Sample]:
        """Return the latest parent and pose of each frame that has a parent, by name."""
        return self.buffer.known_frames.latest_of_all()

    def _direct(self, target: str, source: str) -> Pose | None:
        """Return the latest pose of a frame in its parent or child, the most common case."""
        below = self.buffer.known_frames.latest(source)
        if below is not None and below.parent == target:
            return _pose(below.pose)
        above = self.buffer.known_frames.latest(target)
        if above is not None and above.parent == source:
            return _pose(inverse(above.pose))
        return None

    def _named(self, frame: str) -> str:
        return self.fixed_frame if frame == FIXED_FRAME else frame.lstrip('/')


def _numbers(pose: Pose) -> Numbers:
    """Convert a pose to the form of tf2, whose quaternions have w last."""
    w, x, y, z = pose.wxyz
    return (*pose.position, x, y, z, w)


def _pose(numbers: Numbers) -> Pose:
    """Convert a pose of tf2, whose quaternions have w last."""
    x, y, z, qx, qy, qz, qw = numbers
    return Pose((x, y, z), (qw, qx, qy, qz))


class FrameListener(TransformListener):
    """
    Transform listener that is polled: it fills a buffer whenever `take_all` is called.

    Waking an executor for each message costs more than reading the transforms from it.
    While it rests, it receives static transforms only: dynamic ones arrive some 100 times a
    second, so that all of them are known again a moment after `resume`.

    Parameters
    ----------
    buffer
        Receives the transforms.
    node
        Subscribes to `/tf` and `/tf_static`.

    """

    def __init__(self, buffer: Buffer, node: Node) -> None:
        super().__init__(buffer, node, qos=MOVING, static_qos=STATIC)

    def take_all(self) -> None:
        """Process all messages received since the last call, static transforms first."""
        for subscription in (self.tf_static_sub, self.tf_sub):
            for _ in range(DEPTH if subscription is not None else 0):
                with subscription.handle:
                    found = subscription.handle.take_message(subscription.msg_type, True)
                if found is None:
                    break
                subscription.callback(found[0])

    def rest(self) -> None:
        """Unsubscribe from `/tf`."""
        if self.tf_sub is not None:
            self.node.destroy_subscription(self.tf_sub)
            self.tf_sub = None

    def resume(self) -> None:
        """Subscribe to `/tf` again."""
        if self.tf_sub is None:
            self.tf_sub = self._subscribe('/tf', False, MOVING)

    def _group(self) -> ReentrantCallbackGroup:
        return WaitingGroup()

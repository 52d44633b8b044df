# SPDX-License-Identifier: Apache-2.0
"""Transforms computed for one robot description: which are due, and the messages with them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from builtin_interfaces.msg import Time
from geometry_msgs.msg import TransformStamped
from robot_state_publisher.moving_links import MovingLinks, UnusableStateError
from robot_state_publisher.settings import Settings
from robot_state_publisher.state_watch import StateWatch
from tf2_msgs.msg import TFMessage
from urdf import Joint, RobotModel
from urdf.kinematics import joint_motion, Pose

__all__ = ['PublishTimes', 'PublishedRobot']

MAX_LISTS = 64
"""Maximum number of cached name lists; usually, each source of joint states has one."""

S = 1_000_000_000
JUMP_NS = S
"""Tolerance for out-of-order stamps of several sources; a larger step back is a time jump."""
SLACK = 0.1
"""Tolerance for jitter, so that a source at this frequency does not lose every other state."""


class PublishedRobot:
    """
    Converts the joint states of one robot description to transforms.

    Parameters
    ----------
    model
        The robot.
    settings
        The parameters of the node, of which the rate, `ignore_timestamp` and the prefix are used.

    Attributes
    ----------
    times
        The rate limit.
    watch
        Check for missing or unknown joints in the joint states.

    """

    def __init__(self, model: RobotModel, settings: Settings) -> None:
        self.model = model
        self.times = PublishTimes(settings.publish_frequency)
        self.watch = StateWatch(model)
        self._settings = settings
        self._lists: dict[tuple[str, ...], tuple[MovingLinks, _TransformMessages]] = {}

    def fixed_transforms(self, stamp: Time) -> TFMessage:
        """
        Build the static transforms: those of fixed joints, and of planar joints at position 0.

        Parameters
        ----------
        stamp
            The stamp of all transforms.

        """
        joints = [joint for joint in self.model.joints if joint.kind in ('fixed', 'planar')]
        messages = _TransformMessages(joints, self._settings.frame_prefix)
        return messages.fill(stamp, [joint_motion(joint)(0.0) for joint in joints])

    def transforms(
        self, names: tuple[str, ...], positions: Sequence[float], stamp: Time
    ) -> TFMessage | None:
        """
        Compute the transforms of a joint state, if they are due.

        Parameters
        ----------
        names
            The joints of the state.
        positions
            Their positions, in rad or m.
        stamp
            The stamp of the state, which becomes that of the transforms.

        Returns
        -------
        TFMessage or None
            None if the rate limit applies, or the names drive no joint. The message is reused for
            the next state with the same names.

        Raises
        ------
        UnusableStateError
            The position of a mimic joint would not be finite.

        """
        stamp_ns = stamp.sec * S + stamp.nanosec
        if not self._settings.ignore_timestamp and not self.times.is_due(names, stamp_ns):
            return None
        self.times.note(names, stamp_ns)
        links, messages = self._lists.get(names) or self._remember(names)
        return messages.fill(stamp, links.poses(positions)) if links.joints else None

    def require_stamp(self, stamp: Time) -> None:
        """
        Reject a joint state without a stamp, unless stamps are ignored.

        Parameters
        ----------
        stamp
            The stamp of the state; 0 means that it has none.

        Raises
        ------
        UnusableStateError
            The state lacks the required stamp.

        """
        if not (self._settings.ignore_timestamp or stamp.sec or stamp.nanosec):
            raise UnusableStateError(
                'A joint state without a stamp is ignored. Stamp it, or set the parameter '
                'ignore_timestamp.'
            )

    def notice_time(self, names: Sequence[str], stamp: Time) -> str | None:
        """
        Reset the rate limit if the stamps of joint states have jumped back.

        Parameters
        ----------
        names
            The joints of the state.
        stamp
            The stamp of the state.

        Returns
        -------
        str or None
            The message for the log; None if there was no jump.

        """
        if self._settings.ignore_timestamp:
            return None
        if not self.times.went_back(names, stamp.sec * S + stamp.nanosec):
            return None
        self.times.forget()
        return 'The stamps of joint states have jumped back: all joints are published again.'

    def knows(self, names: tuple[str, ...]) -> bool:
        """
        Check whether a list of joint names is cached from an earlier joint state.

        Parameters
        ----------
        names
            The joints of the state, in the order of the message.

        """
        return names in self._lists

    def _remember(self, names: tuple[str, ...]) -> tuple[MovingLinks, _TransformMessages]:
        """Build the kinematics and the messages for a new list of names."""
        if len(self._lists) >= MAX_LISTS:
            self._lists.clear()
        links = MovingLinks(self.model, names)
        self._lists[names] = links, _TransformMessages(links.joints, self._settings.frame_prefix)
        return self._lists[names]


class PublishTimes:
    """
    Limits the rate at which joints are published, by the stamps of their states.

    Parameters
    ----------
    frequency_hz
        The maximum rate for a joint, in Hz; intervals may be 10 % shorter, to tolerate jitter of
        the sources.

    """

    def __init__(self, frequency_hz: float) -> None:
        self._interval_ns = round(S / frequency_hz * (1.0 - SLACK))
        self._last_ns: dict[str, int] = {}

    def went_back(self, names: Iterable[str], stamp_ns: int) -> bool:
        """
        Check whether a stamp is more than 1 s older than the published one: time has jumped back.

        Parameters
        ----------
        names
            The joints of the state; the least recently published one is decisive.
        stamp_ns
            The stamp of the state, in ns.

        """
        return stamp_ns < self._oldest(names) - JUMP_NS

    def forget(self) -> None:
        """Reset the rate limit; the next joint states are due, whatever their stamps."""
        self._last_ns.clear()

    def is_due(self, names: Iterable[str], stamp_ns: int) -> bool:
        """
        Check whether the minimum interval has elapsed for at least one of the joints.

        Parameters
        ----------
        names
            The joints of the state.
        stamp_ns
            The stamp of the state, in ns; a state without a stamp (0) is never due.

        """
        return stamp_ns - self._oldest(names) >= self._interval_ns

    def note(self, names: Iterable[str], stamp_ns: int) -> None:
        """
        Record the publication of joints.

        Parameters
        ----------
        names
            The joints.
        stamp_ns
            The stamp of their state, in ns.

        """
        self._last_ns.update(dict.fromkeys(names, stamp_ns))

    def _oldest(self, names: Iterable[str]) -> int:
        last_ns = self._last_ns
        return min((last_ns.get(name, 0) for name in names), default=0)


class _TransformMessages:
    """
    A message with the transforms of a set of joints, which is built once and reused.

    Parameters
    ----------
    joints
        The joints, in the order of the transforms.
    frame_prefix
        The prefix of all frame names.

    Attributes
    ----------
    message
        The `tf2_msgs/TFMessage`.

    """

    def __init__(self, joints: Sequence[Joint], frame_prefix: str) -> None:
        self._stamp = Time()
        self.message = TFMessage(
            transforms=[_transform(joint, frame_prefix, self._stamp) for joint in joints]
        )
        self._places = [
            (each.transform.translation, each.transform.rotation)
            for each in self.message.transforms
        ]

    def fill(self, stamp: Time, poses: Iterable[Pose]) -> TFMessage:
        """
        Set the stamp and the poses of the message.

        Parameters
        ----------
        stamp
            The stamp of all transforms.
        poses
            Pose of the child link of each joint relative to its parent link, in the order of the
            joints.

        Returns
        -------
        TFMessage
            The same message object on each call.

        """
        self._stamp.sec, self._stamp.nanosec = stamp.sec, stamp.nanosec
        for (at, turn), pose in zip(self._places, poses):
            at.x, at.y, at.z, turn.x, turn.y, turn.z, turn.w = pose
        return self.message


def _transform(joint: Joint, frame_prefix: str, stamp: Time) -> TransformStamped:
    """Create the message of one joint; all messages share the stamp."""
    transform = TransformStamped(child_frame_id=frame_prefix + joint.child)
    transform.header.frame_id = frame_prefix + joint.parent
    transform.header.stamp = stamp
    return transform

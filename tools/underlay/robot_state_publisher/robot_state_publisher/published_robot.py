# SPDX-License-Identifier: Apache-2.0
"""Transforms computed for one robot description."""

from __future__ import annotations

from collections.abc import Sequence

from builtin_interfaces.msg import Time
from robot_state_publisher.joint_positions import UnusableStateError
from robot_state_publisher.moving_links import MovingLinks
from robot_state_publisher.publish_times import PublishTimes, S
from robot_state_publisher.settings import Settings
from robot_state_publisher.state_watch import StateWatch
from robot_state_publisher.transform_messages import TransformMessages
from tf2_msgs.msg import TFMessage
from urdf import RobotModel
from urdf.kinematics import joint_motion

__all__ = ['PublishedRobot']

MAX_LISTS = 64
"""Maximum number of cached name lists; usually, each source of joint states has one."""


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
        self._lists: dict[tuple[str, ...], tuple[MovingLinks, TransformMessages]] = {}

    def fixed_transforms(self, stamp: Time) -> TFMessage:
        """
        Build the static transforms: those of fixed joints, and of planar joints at position 0.

        Parameters
        ----------
        stamp
            The stamp of all transforms.

        """
        joints = [joint for joint in self.model.joints if joint.kind in ('fixed', 'planar')]
        messages = TransformMessages(joints, self._settings.frame_prefix)
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
                'A joint state without a stamp is left out. Stamp it, or set the parameter '
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
        return 'The stamps of joint states have jumped back: all joints are published anew.'

    def knows(self, names: tuple[str, ...]) -> bool:
        """
        Check whether a list of joint names is cached from an earlier joint state.

        Parameters
        ----------
        names
            The joints of the state, in the order of the message.

        """
        return names in self._lists

    def _remember(self, names: tuple[str, ...]) -> tuple[MovingLinks, TransformMessages]:
        """Build the kinematics and the messages for a new list of names."""
        if len(self._lists) >= MAX_LISTS:
            self._lists.clear()
        links = MovingLinks(self.model, names)
        self._lists[names] = links, TransformMessages(links.joints, self._settings.frame_prefix)
        return self._lists[names]

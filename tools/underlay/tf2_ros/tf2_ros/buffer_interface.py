# SPDX-License-Identifier: Apache-2.0
"""Common interface of transform buffers, local or remote."""

from __future__ import annotations

from copy import deepcopy
from typing import Any, Optional, TYPE_CHECKING

from rclpy.duration import Duration
from tf2_ros._registrations import (
    ConvertRegistration,
    TransformRegistration,
    TypeException,
)

if TYPE_CHECKING:
    from geometry_msgs.msg import TransformStamped
    from rclpy.time import Time

__all__ = [
    'BufferInterface',
    'ConvertRegistration',
    'NotImplementedException',
    'Stamped',
    'TransformRegistration',
    'TypeException',
    'convert',
]


class NotImplementedException(Exception):
    """A method is not implemented by a subclass."""

    def __init__(self, method: str = 'This method') -> None:
        super().__init__(f'{method} has to be implemented by a subclass')


class BufferInterface:
    """Interface to look up and apply transforms; subclasses provide the transforms."""

    def __init__(self) -> None:
        """Create the interface, with access to the registered types."""
        self.registration = TransformRegistration()

    def transform(
        self,
        object_stamped: Any,
        target_frame: str,
        timeout: Duration = Duration(),
        new_type: Optional[type] = None,
    ) -> Any:
        """
        Transform an object to another frame, at the time of its header.

        Parameters
        ----------
        object_stamped
            An object with a header, of a type that a package has registered.
        target_frame
            The frame of the result.
        timeout
            The maximum time to wait for the transform; by default no wait.
        new_type
            The type of the result, if not that of the object.

        Returns
        -------
        object
            A new object, of `new_type` if given.

        Raises
        ------
        TypeException
            The object has no header, or no package has registered its type or the conversion.
        TransformException
            The transform is not available.

        """
        do_transform = self._do_transform_of(object_stamped)
        header = object_stamped.header
        transform = self.lookup_transform(target_frame, header.frame_id, header.stamp, timeout)
        return _converted(do_transform(object_stamped, transform), new_type)

    def transform_full(
        self,
        object_stamped: Any,
        target_frame: str,
        target_time: Time,
        fixed_frame: str,
        timeout: Duration = Duration(),
        new_type: Optional[type] = None,
    ) -> Any:
        """
        Transform an object to another frame at another time.

        Parameters
        ----------
        object_stamped
            An object with a header, of a type that a package has registered.
        target_frame, target_time
            The frame of the result, and its time.
        fixed_frame
            The frame that is assumed to be fixed between the header time and the target time.
        timeout
            The maximum time to wait for the transform; by default no wait.
        new_type
            The type of the result, if not that of the object.

        Returns
        -------
        object
            A new object, of `new_type` if given.

        Raises
        ------
        TypeException
            The object has no header, or no package has registered its type or the conversion.
        TransformException
            The transform is not available.

        """
        do_transform = self._do_transform_of(object_stamped)
        header = object_stamped.header
        transform = self.lookup_transform_full(
            target_frame, target_time, header.frame_id, header.stamp, fixed_frame, timeout
        )
        return _converted(do_transform(object_stamped, transform), new_type)

    def _do_transform_of(self, object_stamped: Any) -> Any:
        """Return the registered transform function; raise a TypeException without a header."""
        kind = type(object_stamped)
        if hasattr(object_stamped, 'header'):
            return self.registration.get(kind)
        raise TypeException(
            f'A {kind.__name__} has no header, so neither a frame nor a time: put it into a '
            f'message with one, such as {kind.__name__}Stamped, or look up the transform and '
            'apply a function like tf2_geometry_msgs.do_transform_pose'
        )

    def lookup_transform(
        self,
        target_frame: str,
        source_frame: str,
        time: Time,
        timeout: Duration = Duration(),
    ) -> TransformStamped:
        """
        Look up the transform between two frames; to be implemented by subclasses.

        Parameters
        ----------
        target_frame
            The frame of the result.
        source_frame
            The frame of the data.
        time
            The time of the transform; 0 is the latest.
        timeout
            The maximum time to wait for it.

        Returns
        -------
        TransformStamped
            Pose of the source frame in the target frame.

        Raises
        ------
        NotImplementedException
            The subclass does not implement this method.

        """
        raise NotImplementedException('lookup_transform')

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: Time,
        source_frame: str,
        source_time: Time,
        fixed_frame: str,
        timeout: Duration = Duration(),
    ) -> TransformStamped:
        """
        Look up the transform between two frames at two times; to be implemented by subclasses.

        Parameters
        ----------
        target_frame, target_time
            The frame of the result, and its time; 0 is the latest.
        source_frame, source_time
            The frame of the data, and its time; 0 is the latest.
        fixed_frame
            The frame that is assumed to be fixed between the two times.
        timeout
            The maximum time to wait for it.

        Returns
        -------
        TransformStamped
            Pose of the source frame at its time in the target frame at its time.

        Raises
        ------
        NotImplementedException
            The subclass does not implement this method.

        """
        raise NotImplementedException('lookup_transform_full')

    def can_transform(
        self,
        target_frame: str,
        source_frame: str,
        time: Time,
        timeout: Duration = Duration(),
    ) -> Any:
        """
        Check whether `lookup_transform` succeeds; to be implemented by subclasses.

        Parameters
        ----------
        target_frame, source_frame, time, timeout
            As for `lookup_transform`.

        Raises
        ------
        NotImplementedException
            The subclass does not implement this method.

        """
        raise NotImplementedException('can_transform')

    def can_transform_full(
        self,
        target_frame: str,
        target_time: Time,
        source_frame: str,
        source_time: Time,
        fixed_frame: str,
        timeout: Duration = Duration(),
    ) -> Any:
        """
        Check whether `lookup_transform_full` succeeds; to be implemented by subclasses.

        Parameters
        ----------
        target_frame, target_time, source_frame, source_time, fixed_frame, timeout
            As for `lookup_transform_full`.

        Raises
        ------
        NotImplementedException
            The subclass does not implement this method.

        """
        raise NotImplementedException('can_transform_full')


def Stamped(obj: Any, stamp: Any, frame_id: str) -> Any:  # noqa: N802
    """
    Set the header of an object and return the object.

    Parameters
    ----------
    obj
        The object whose attribute `header` is set.
    stamp
        The timestamp, a `builtin_interfaces/Time`.
    frame_id
        The frame.

    """
    from std_msgs.msg import Header

    obj.header = Header(frame_id=frame_id, stamp=stamp)
    return obj


def convert(a: Any, b_type: type) -> Any:
    """
    Convert an object to another type by the registered conversions.

    A direct conversion is preferred over one via a message. Objects that already have the type are
    copied.

    Parameters
    ----------
    a
        The object, which is not modified.
    b_type
        The type of the result.

    Raises
    ------
    TypeException
        No package has registered the conversion.

    """
    registration = ConvertRegistration()
    direct = registration.get_convert((type(a), b_type))
    if direct is not None:
        return direct(a)
    if isinstance(a, b_type):
        return deepcopy(a)
    to_message = registration.get_to_msg(type(a))
    return registration.get_from_msg(b_type)(to_message(a))


def _converted(result: Any, new_type: Optional[type]) -> Any:
    return result if new_type is None else convert(result, new_type)

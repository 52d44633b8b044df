# SPDX-License-Identifier: Apache-2.0
"""Why there is no transform."""

from __future__ import annotations

__all__ = [
    'ConnectivityException',
    'ExtrapolationException',
    'InvalidArgumentException',
    'LookupException',
    'TimeoutException',
    'TransformException',
]


class TransformException(Exception):
    """The base of all reasons why there is no transform."""


class ConnectivityException(TransformException):
    """The frames are in different trees."""


class LookupException(TransformException):
    """There is no such frame."""


class ExtrapolationException(TransformException):
    """The buffer has the frames, but not at that time."""


class InvalidArgumentException(TransformException):
    """A name of a frame that cannot be one, or a quaternion that is no rotation."""


class TimeoutException(TransformException):
    """The time to wait is over."""

# SPDX-License-Identifier: Apache-2.0
"""Exceptions of failed lookups."""

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
    """Base class of all tf2 exceptions."""


class ConnectivityException(TransformException):
    """The frames are in different trees."""


class LookupException(TransformException):
    """The frame does not exist."""


class ExtrapolationException(TransformException):
    """The requested time is outside the buffered samples of a frame."""


class InvalidArgumentException(TransformException):
    """A frame name or a quaternion is invalid."""


class TimeoutException(TransformException):
    """The timeout has expired."""

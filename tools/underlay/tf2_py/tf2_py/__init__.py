# SPDX-License-Identifier: Apache-2.0
"""Core of tf2, without ROS nodes: transform buffer and exceptions."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros_environment.lazy import lazy_exports

if TYPE_CHECKING:
    from tf2_py.buffer_core import BufferCore
    from tf2_py.exceptions import (
        ConnectivityException,
        ExtrapolationException,
        InvalidArgumentException,
        LookupException,
        TimeoutException,
        TransformException,
    )

__all__ = [
    'BufferCore',
    'ConnectivityException',
    'ExtrapolationException',
    'InvalidArgumentException',
    'LookupException',
    'TimeoutException',
    'TransformException',
]

__getattr__, __dir__ = lazy_exports(
    __name__,
    ['BufferCore'],
    {name: 'exceptions' for name in __all__ if name.endswith('Exception')},
)

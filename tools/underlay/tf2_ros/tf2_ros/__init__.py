# SPDX-License-Identifier: Apache-2.0
"""ROS interface of tf2: transform buffer, listener and broadcasters."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros_environment.lazy import lazy_exports
from tf2_py.exceptions import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TimeoutException,
    TransformException,
)

if TYPE_CHECKING:
    from tf2_py import BufferCore
    from tf2_ros import (
        buffer,
        buffer_client,
        buffer_interface,
        buffer_server,
        static_transform_broadcaster,
        transform_broadcaster,
        transform_listener,
    )
    from tf2_ros.buffer import Buffer
    from tf2_ros.buffer_client import BufferClient
    from tf2_ros.buffer_interface import (
        BufferInterface,
        convert,
        ConvertRegistration,
        NotImplementedException,
        Stamped,
        TransformRegistration,
        TypeException,
    )
    from tf2_ros.buffer_server import BufferServer
    from tf2_ros.static_transform_broadcaster import StaticTransformBroadcaster
    from tf2_ros.transform_broadcaster import TransformBroadcaster
    from tf2_ros.transform_listener import TransformListener

__all__ = [
    'Buffer',
    'BufferClient',
    'BufferCore',
    'BufferInterface',
    'BufferServer',
    'ConnectivityException',
    'ConvertRegistration',
    'ExtrapolationException',
    'InvalidArgumentException',
    'LookupException',
    'NotImplementedException',
    'Stamped',
    'StaticTransformBroadcaster',
    'TimeoutException',
    'TransformBroadcaster',
    'TransformException',
    'TransformListener',
    'TransformRegistration',
    'TypeException',
    'buffer',
    'buffer_client',
    'buffer_interface',
    'buffer_server',
    'convert',
    'static_transform_broadcaster',
    'transform_broadcaster',
    'transform_listener',
]

_FROM_INTERFACE = [
    'ConvertRegistration',
    'NotImplementedException',
    'Stamped',
    'TransformRegistration',
    'TypeException',
    'convert',
]
_MODULES = [name for name in __all__ if name.islower() and name != 'convert']

__getattr__, __dir__ = lazy_exports(
    __name__,
    __all__,
    {
        'BufferCore': '_waiting',
        **dict.fromkeys(_FROM_INTERFACE, 'buffer_interface'),
        **dict.fromkeys(_MODULES, ''),
    },
)

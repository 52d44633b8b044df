# SPDX-License-Identifier: Apache-2.0
"""
Messages of several topics, synchronized by their timestamps.

Filters form chains: each gets messages from others, and its output goes to the functions that were
given to `registerCallback`::

    image = Subscriber(node, Image, 'image')
    info = Subscriber(node, CameraInfo, 'camera_info')
    both = ApproximateTimeSynchronizer([image, info], queue_size=10, slop=0.1)
    both.registerCallback(lambda image, info: ...)
"""

from message_filters.cache import Cache
from message_filters.chain import Chain
from message_filters.simple_filter import SimpleFilter
from message_filters.subscriber import Subscriber
from message_filters.synchronizers import ApproximateTimeSynchronizer, TimeSynchronizer

__all__ = [
    'ApproximateTimeSynchronizer',
    'Cache',
    'Chain',
    'SimpleFilter',
    'Subscriber',
    'TimeSynchronizer',
]

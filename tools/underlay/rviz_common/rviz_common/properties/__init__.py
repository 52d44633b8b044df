# SPDX-License-Identifier: Apache-2.0
"""The properties of displays, tools and views, and their values."""

from rviz_common.properties.property import (
    Choice,
    ColorOf,
    Flag,
    Flags,
    Frame,
    Number,
    Property,
    Text,
    Topic,
    Vector,
    Whole,
)
from rviz_common.properties.topic_properties import qos_of, topic_path, topic_properties
from rviz_common.properties.values import Values

__all__ = [
    'Choice',
    'ColorOf',
    'Flag',
    'Flags',
    'Frame',
    'Number',
    'Property',
    'Text',
    'Topic',
    'Values',
    'Vector',
    'Whole',
    'qos_of',
    'topic_path',
    'topic_properties',
]

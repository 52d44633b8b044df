# SPDX-License-Identifier: Apache-2.0
"""What can be set of a display, a tool or a view, and what it is set to."""

from rviz_common.properties.property import (
    Choice,
    ColorOf,
    Flag,
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

# SPDX-License-Identifier: Apache-2.0
"""Parameters of the node `object_memory`."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_common.parameters import parameter

__all__ = ['MemoryParameters']

_CLASSES = (
    *('mug', 'bottle', 'can', 'bowl', 'ball', 'apple', 'orange', 'box', 'cube', 'book'),
    'person',
)


@dataclass(frozen=True)
class MemoryParameters:
    """The parameters of the node."""

    map_frame: str = parameter('map', 'The frame of remembered objects, if it exists.')
    odom_frame: str = parameter('odom', 'The frame of remembered objects otherwise.')
    places_file: str = parameter(
        '',
        'The named places: a YAML file, or the name of one in this package (apartment).',
        read_only=True,
    )
    hand_frames: tuple[str, ...] = parameter(
        ('l_gripper', 'r_gripper'),
        "Frames of the robot's own hands; detections there are ignored.",
    )
    classes: tuple[str, ...] = parameter(
        _CLASSES, 'Classes of the detector; a query for any other class is rejected.'
    )
    birth_sightings: int = parameter(
        3, 'Images with a detection before an object is remembered.', at_least=1, at_most=100
    )
    max_range_m: float = parameter(
        3.0, 'Range within which a detection is expected (m).', at_least=0.1, at_most=50.0
    )
    min_size_px: float = parameter(
        8.0, 'Size from which a detection is expected (pixels).', at_least=1.0, at_most=1000.0
    )
    max_things: int = parameter(300, 'Maximum number of objects.', at_least=1, at_most=10_000)
    follows_jumps: bool = parameter(
        True, 'Whether objects move along when the localization jumps.'
    )
    publish_rate_hz: float = parameter(
        2.0, 'Highest rate at which changes are published (Hz).', at_least=0.1, at_most=20.0,
        read_only=True,
    )  # fmt: skip

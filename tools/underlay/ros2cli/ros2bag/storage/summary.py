# SPDX-License-Identifier: Apache-2.0
"""Merged metadata of several files."""

from __future__ import annotations

from collections.abc import Iterable

from ros2bag.storage.metadata import BagMetadata, TopicInformation

__all__ = ['merged']


def merged(parts: Iterable[BagMetadata]) -> BagMetadata:
    """
    Merge the metadata of files into those of their bag.

    Parameters
    ----------
    parts
        One per file, in their order; the last description of a topic counts.

    """
    parts = list(parts)
    topics: dict[str, TopicInformation] = {}
    for information in (each for part in parts for each in part.topics):
        name = information.topic.name
        before = topics[name].message_count if name in topics else 0
        topics[name] = TopicInformation(information.topic, before + information.message_count)
    return BagMetadata(
        files=tuple(file for part in parts for file in part.files),
        topics=tuple(topics[name] for name in sorted(topics)),
        ros_distro=next((part.ros_distro for part in parts if part.ros_distro), ''),
    )

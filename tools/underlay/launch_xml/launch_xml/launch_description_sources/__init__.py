# SPDX-License-Identifier: Apache-2.0
"""The source of launch descriptions in XML."""

from __future__ import annotations

from launch_xml.launch_description_sources.xml_launch_description_source import (
    XMLLaunchDescriptionSource,
)

__all__ = [
    'XMLLaunchDescriptionSource',
]

# SPDX-License-Identifier: Apache-2.0
"""Launch files in YAML."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros_environment.lazy import lazy_exports

if TYPE_CHECKING:
    from launch_yaml import launch_description_sources
    from launch_yaml.entity import Entity
    from launch_yaml.parser import Parser

__all__ = [
    'Entity',
    'Parser',
    'launch_description_sources',
]

_ELSEWHERE = {
    'launch_description_sources': '',
}

__getattr__, __dir__ = lazy_exports(__name__, __all__, _ELSEWHERE)

# SPDX-License-Identifier: Apache-2.0
"""Descriptions of the executables that actions run."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros_environment.lazy import lazy_exports

if TYPE_CHECKING:
    from launch.descriptions.executable import Executable

__all__ = [
    'Executable',
]

__getattr__, __dir__ = lazy_exports(__name__, __all__)

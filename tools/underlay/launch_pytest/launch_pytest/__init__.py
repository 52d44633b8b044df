# SPDX-License-Identifier: Apache-2.0
"""Test launch descriptions with ordinary pytest functions."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros_environment.lazy import lazy_exports

if TYPE_CHECKING:
    from launch_pytest import actions, tools
    from launch_pytest._fixture import fixture

__all__ = ['actions', 'fixture', 'tools']

__getattr__, __dir__ = lazy_exports(
    __name__, __all__, {'actions': '', 'fixture': '_fixture', 'tools': ''}
)

# SPDX-License-Identifier: Apache-2.0
"""Launch actions for launch descriptions under test."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros_environment.lazy import lazy_exports

if TYPE_CHECKING:
    from launch_testing.actions.ready_to_test import ReadyToTest

__all__ = ['ReadyToTest']

__getattr__, __dir__ = lazy_exports(__name__, __all__)

# SPDX-License-Identifier: Apache-2.0
"""Launch actions for launch descriptions under test."""

from __future__ import annotations

from launch_testing.actions.ready_to_test import ReadyToTest

__all__ = ['ReadyToTest']

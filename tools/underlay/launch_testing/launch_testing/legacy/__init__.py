# SPDX-License-Identifier: Apache-2.0
"""Legacy interface for tests of launch descriptions, which predates launch test files."""

from __future__ import annotations

from launch_testing.launch_test_service import LaunchTestService

__all__ = ['LaunchTestService']

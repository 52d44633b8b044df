# SPDX-License-Identifier: Apache-2.0
"""The tests of launch descriptions that came before launch test files."""

from __future__ import annotations

from launch_testing.launch_test_service import LaunchTestService

__all__ = ['LaunchTestService']

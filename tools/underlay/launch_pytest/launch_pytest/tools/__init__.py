# SPDX-License-Identifier: Apache-2.0
"""Tools for tests."""

from __future__ import annotations

from launch_pytest.tools import process

__all__ = ['process']

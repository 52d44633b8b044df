# SPDX-License-Identifier: Apache-2.0
"""Lifecycle manager: brings the nodes of navigation up and down in order, and monitors them."""

from nav2_lifecycle_manager.lifecycle_manager import LifecycleManager

__all__ = ['LifecycleManager']

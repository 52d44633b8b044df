# SPDX-License-Identifier: Apache-2.0
"""Brings the nodes of navigation up and down in order, and watches over them."""

from nav2_lifecycle_manager.lifecycle_manager import LifecycleManager

__all__ = ['LifecycleManager']

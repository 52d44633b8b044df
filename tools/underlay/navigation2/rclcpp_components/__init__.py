# SPDX-License-Identifier: Apache-2.0
"""Component containers: processes that load and unload Python nodes at run time."""

from rclcpp_components.registry import ComponentError, find_component

__all__ = ['ComponentError', 'find_component']

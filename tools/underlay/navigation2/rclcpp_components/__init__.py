# SPDX-License-Identifier: Apache-2.0
"""Containers: processes that load and unload nodes at run time, classes of Python here."""

from rclcpp_components.registry import ComponentError, find_component

__all__ = ['ComponentError', 'find_component']

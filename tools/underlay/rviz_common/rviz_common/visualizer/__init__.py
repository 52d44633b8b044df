# SPDX-License-Identifier: Apache-2.0
"""The visualizer: the displays, tools, views and panels of a file."""

from rviz_common.visualizer.display_tree import Entry, Group
from rviz_common.visualizer.visualizer import Visualizer

__all__ = ['Entry', 'Group', 'Visualizer']

# SPDX-License-Identifier: Apache-2.0
"""Panels with a web page that receives updates while it is open."""

from robot_console.live.channel import Channel
from robot_console.live.live_panel import LivePanel
from robot_console.live.viewer import Viewer

__all__ = ['Channel', 'LivePanel', 'Viewer']

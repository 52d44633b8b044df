# SPDX-License-Identifier: Apache-2.0
"""Panels whose small pages are told what is new, as long as somebody looks at them."""

from robot_console.live.channel import Channel
from robot_console.live.live_panel import LivePanel
from robot_console.live.viewer import Viewer

__all__ = ['Channel', 'LivePanel', 'Viewer']

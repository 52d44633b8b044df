# SPDX-License-Identifier: Apache-2.0
"""DWB, a controller plugin."""

from dwb_core.local_planner import DWBLocalPlanner

__all__ = ['DWBLocalPlanner']

# SPDX-License-Identifier: Apache-2.0
"""Behaviours that need no planned path: spin, back up, drive on heading, wait, assisted teleop."""

from nav2_behaviors.behavior_server import behavior_types, BehaviorServer
from nav2_behaviors.timed_behavior import TimedBehavior

__all__ = ['BehaviorServer', 'TimedBehavior', 'behavior_types']

# SPDX-License-Identifier: Apache-2.0
"""The waypoint follower: drives the robot from one waypoint to the next."""

from nav2_waypoint_follower.waypoint_follower import WaypointFollower

__all__ = ['WaypointFollower']

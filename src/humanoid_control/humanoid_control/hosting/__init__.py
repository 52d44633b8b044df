# SPDX-License-Identifier: Apache-2.0
"""
What runs robots: backend and controllers in lockstep, and their topics.

- `humanoid_control.hosting.robot_control`: all that decides what one robot does (no ROS needed)
- `humanoid_control.hosting.control_loop`: a backend and its robots, tick by tick (no ROS needed)
- `humanoid_control.hosting.host_node`: the node that runs the loop in real time or faster
"""

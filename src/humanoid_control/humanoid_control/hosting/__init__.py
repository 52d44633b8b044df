# SPDX-License-Identifier: Apache-2.0
"""
Hosting of robots in a node: backend and controllers in lockstep, and their topics.

- `humanoid_control.hosting.robot_control`: the control of one robot (no ROS needed)
- `humanoid_control.hosting.control_loop`: a backend and its robots, tick by tick (no ROS needed)
- `humanoid_control.hosting.host`: runs the loop in a node, in real time or faster
"""

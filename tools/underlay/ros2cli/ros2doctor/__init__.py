# SPDX-License-Identifier: Apache-2.0
"""The command `ros2 doctor`: what is wrong with a ROS 2 setup, why it matters, how to mend it."""

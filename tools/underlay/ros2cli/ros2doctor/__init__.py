# SPDX-License-Identifier: Apache-2.0
"""The command `ros2 doctor`: problems of a ROS 2 setup, why they matter and how to fix them."""

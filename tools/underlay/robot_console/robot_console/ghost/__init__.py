# SPDX-License-Identifier: Apache-2.0
"""Commanded pose of the robot; without ROS."""

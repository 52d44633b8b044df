# SPDX-License-Identifier: Apache-2.0
"""Measured and commanded joint states; without ROS."""

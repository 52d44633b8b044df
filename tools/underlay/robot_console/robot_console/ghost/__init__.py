# SPDX-License-Identifier: Apache-2.0
"""The robot as it was told to stand; without ROS."""

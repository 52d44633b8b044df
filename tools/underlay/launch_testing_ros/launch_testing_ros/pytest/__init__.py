# SPDX-License-Identifier: Apache-2.0
"""Pytest plugin that runs launch tests of ROS nodes."""

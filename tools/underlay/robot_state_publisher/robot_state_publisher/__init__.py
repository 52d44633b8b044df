# SPDX-License-Identifier: Apache-2.0
"""Publish the link transforms of a robot, computed from its URDF and its joint states."""

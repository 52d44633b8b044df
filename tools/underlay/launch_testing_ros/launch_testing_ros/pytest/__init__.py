# SPDX-License-Identifier: Apache-2.0
"""The part of pytest that runs launch tests of ROS nodes."""

# SPDX-License-Identifier: Apache-2.0
"""The environment of a ROS 2 installation and the workspace around the current folder."""

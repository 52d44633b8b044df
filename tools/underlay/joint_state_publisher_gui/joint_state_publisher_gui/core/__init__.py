# SPDX-License-Identifier: Apache-2.0
"""Joint groups, slider values and saved poses; without ROS and without a page."""

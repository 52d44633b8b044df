# SPDX-License-Identifier: Apache-2.0
"""Groups of joints, what sliders show, and saved poses; without ROS and without a page."""

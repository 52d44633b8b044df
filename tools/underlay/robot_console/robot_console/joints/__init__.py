# SPDX-License-Identifier: Apache-2.0
"""What a robot says about its joints, beside what it was told; without ROS."""

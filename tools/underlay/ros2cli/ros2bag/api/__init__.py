# SPDX-License-Identifier: Apache-2.0
"""Recording and playing, which need ROS, and what the verbs print."""

# SPDX-License-Identifier: Apache-2.0
"""Recording and playback, which need ROS, and the output of the verbs."""

# SPDX-License-Identifier: Apache-2.0
"""The graph of nodes, topics and services, read without rclpy and without a daemon."""

DEFAULT_SPIN_TIME_S = 0.5

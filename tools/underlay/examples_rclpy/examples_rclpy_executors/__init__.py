# SPDX-License-Identifier: Apache-2.0
"""Executors and callback groups: those of rclpy, and some that are made here."""

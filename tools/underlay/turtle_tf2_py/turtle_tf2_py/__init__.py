# SPDX-License-Identifier: Apache-2.0
"""Nodes that show tf2 with the turtles of turtlesim."""

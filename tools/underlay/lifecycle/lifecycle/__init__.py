# SPDX-License-Identifier: Apache-2.0
"""Nodes that show the lifecycle of a node."""

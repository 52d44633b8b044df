# SPDX-License-Identifier: Apache-2.0
"""Nodes that show the logger service."""

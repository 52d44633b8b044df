# SPDX-License-Identifier: Apache-2.0
"""Nodes that are told of events."""

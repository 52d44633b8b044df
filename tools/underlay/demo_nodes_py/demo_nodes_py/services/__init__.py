# SPDX-License-Identifier: Apache-2.0
"""Nodes that offer or call a service."""

# SPDX-License-Identifier: Apache-2.0
"""The hidden node of verbs, and their access to the graph."""

NODE_NAME_PREFIX = '_ros2cli'
HIDDEN_NODE_PREFIX = '_'

__all__ = ['HIDDEN_NODE_PREFIX', 'NODE_NAME_PREFIX']

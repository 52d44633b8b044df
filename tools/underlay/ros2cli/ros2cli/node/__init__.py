# SPDX-License-Identifier: Apache-2.0
"""The hidden node through which verbs see the graph."""

NODE_NAME_PREFIX = '_ros2cli'
HIDDEN_NODE_PREFIX = '_'

__all__ = ['HIDDEN_NODE_PREFIX', 'NODE_NAME_PREFIX']

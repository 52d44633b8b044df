# SPDX-License-Identifier: Apache-2.0
"""The node of verbs that only read the graph; without a daemon it is always a direct one."""

from __future__ import annotations

from ros2cli.node.arguments import add_strategy_arguments as add_arguments
from ros2cli.node.direct import DirectNode as NodeStrategy

__all__ = ['NodeStrategy', 'add_arguments']

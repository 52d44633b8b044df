# SPDX-License-Identifier: Apache-2.0
"""The executable of a standalone costmap: /costmap/costmap."""

from __future__ import annotations

from nav2_costmap_2d.costmap_node import Costmap2DROS
from nav2_util.main import main as run_main

__all__ = ['main']


def main() -> int:
    """Spin the node until a signal; return the exit status."""
    return run_main(lambda: Costmap2DROS('costmap', namespace='costmap'))

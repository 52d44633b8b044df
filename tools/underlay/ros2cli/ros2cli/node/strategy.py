# SPDX-License-Identifier: Apache-2.0
"""What verbs that only read the graph use instead of a node: there is no daemon."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from contextlib import contextmanager

from ros2cli.graph.graph import Graph
from ros2cli.graph.watch import GraphWatch
from ros2cli.node.arguments import add_strategy_arguments as add_arguments

__all__ = ['NodeStrategy', 'add_arguments']


@contextmanager
def NodeStrategy(args: argparse.Namespace) -> Iterator[Graph]:  # noqa: N802
    """Yield the complete graph; the name is the one that extensions know."""
    with GraphWatch(args.spin_time) as watch:
        graph = watch.settled()
    yield graph

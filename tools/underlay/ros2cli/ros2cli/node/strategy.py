# SPDX-License-Identifier: Apache-2.0
"""What verbs that only read the graph use instead of a node: there is no daemon."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from ros2cli.graph.graph import Graph
from ros2cli.graph.watch import GraphWatch
from ros2cli.node.arguments import add_strategy_arguments as add_arguments

__all__ = ['NodeStrategy', 'add_arguments']


@contextmanager
def NodeStrategy(  # noqa: N802
    args: argparse.Namespace, find: Callable[[Graph], object] = lambda _: True
) -> Iterator[Graph]:
    """
    Yield the complete graph; the name is the one that extensions know.

    What `find` does not find at once is waited for during the spin time.
    """
    with GraphWatch(args.spin_time) as watch:
        graph = watch.settled_with(find)
    yield graph

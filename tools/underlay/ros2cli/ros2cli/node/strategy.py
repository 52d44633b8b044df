# SPDX-License-Identifier: Apache-2.0
"""The node strategy of verbs that only read the graph; there is no daemon."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from ros2cli.arguments import add_strategy_arguments as add_arguments
from ros2cli.graph.graph import Graph
from ros2cli.graph.watch import GraphWatch

__all__ = ['NodeStrategy', 'add_arguments']


@contextmanager
def NodeStrategy(  # noqa: N802
    args: argparse.Namespace, find: Callable[[Graph], object] = lambda _: True
) -> Iterator[Graph]:
    """
    Yield the complete graph, in a `with` statement; extensions know it by this name.

    Parameters
    ----------
    args : argparse.Namespace
        The options of `add_strategy_arguments`.
    find
        Searches a graph; a result is waited for during the spin time.

    Yields
    ------
    Graph
        The graph, a snapshot that does not change.

    """
    with GraphWatch(args.spin_time) as watch:
        graph = watch.settled_with(find)
    yield graph

# SPDX-License-Identifier: Apache-2.0
"""Circles and the longest chain of a graph, such as that of modules that import each other."""

from __future__ import annotations


def circles(graph: dict[str, set[str]]) -> list[set[str]]:
    """Return the strongly connected parts of a graph, those first that others lead to.

    Parameters
    ----------
    graph : dict of str to set of str
        The successors of each node.

    Returns
    -------
    list of set of str
        Each node is in one of the sets; a set of several is a circle of imports. After Tarjan,
        "Depth-first search and linear graph algorithms" (1972).

    """
    order: dict[str, int] = {}
    lowest: dict[str, int] = {}
    path: list[str] = []
    found: list[set[str]] = []

    def visit(node: str) -> None:
        order[node] = lowest[node] = len(order)
        path.append(node)
        for other in sorted(graph[node]):
            if other not in order:
                visit(other)
            if other in path:
                lowest[node] = min(lowest[node], lowest[other])
        if lowest[node] == order[node]:
            start = path.index(node)
            found.append(set(path[start:]))
            del path[start:]

    for node in sorted(graph):
        if node not in order:
            visit(node)
    return found


def chain(graph: dict[str, set[str]]) -> list[str]:
    """Return the longest chain of imports; of a circle it passes one module.

    Parameters
    ----------
    graph : dict of str to set of str
        The modules that each module imports.

    Returns
    -------
    list of str
        Modules of which each imports the next, or a module in a circle with it.

    """
    longest: dict[str, list[str]] = {}
    for circle in circles(graph):
        onward = {other for node in circle for other in graph[node]} - circle
        rest = max((longest[each] for each in sorted(onward)), key=len, default=[])
        for node in circle:
            longest[node] = [node, *rest]
    return max(longest.values(), key=len, default=[])

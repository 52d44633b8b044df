# SPDX-License-Identifier: Apache-2.0
"""Find the corridor of a large grid that contains the cheapest path; no gap is too narrow."""

from __future__ import annotations

from dataclasses import dataclass, field

import cv2
from nav2_planner.grid_graph import Cell, FloatGrid, MaskGrid, shortest_paths
import numpy as np
import numpy.typing as npt
from scipy.sparse import coo_array, csr_array

__all__ = ['BlockGraph', 'block_graph', 'corridor']


@dataclass(frozen=True)
class BlockGraph:
    """
    Coarse graph of a grid in square blocks; its nodes are 4-connected components of blocks.

    Two nodes are connected if and only if their cells touch, so the connectivity of the graph is
    exactly that of the grid: one-cell gaps stay open, and one-cell walls stay closed.

    Attributes
    ----------
    side
        Cells along the side of a block.
    nodes
        (rows, columns) index of each cell's node, 0 where there is none; padded to full blocks.
    shape
        Rows and columns of the grid itself.
    blocks
        (2, nodes) row and column of each node's block.
    lengths, neighbours, starts
        The edges as compressed sparse rows; a length is the cost of the path between centroids.

    """

    side: int
    nodes: npt.NDArray[np.int32]
    shape: tuple[int, int]
    blocks: npt.NDArray[np.int32]
    lengths: npt.NDArray[np.float64]
    neighbours: npt.NDArray[np.int32]
    starts: npt.NDArray[np.int32]
    _known: dict[int, tuple[npt.NDArray[np.float64], npt.NDArray[np.int32]]] = field(
        default_factory=dict, repr=False
    )

    def costs_from(self, cell: Cell) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.int32]]:
        """
        Compute the costs of the cheapest paths from a cell to all nodes; the last three are kept.

        Parameters
        ----------
        cell
            Row and column of a cell that has a node.

        Returns
        -------
        tuple
            (nodes,) cost to each node in cells times weights, infinite if unreachable; and
            (nodes,) the predecessor of each node, negative at the node of the cell itself.

        """
        node = int(self.nodes[cell])
        if node not in self._known:
            while len(self._known) > 2:
                self._known.pop(next(iter(self._known)))
            self._known[node] = shortest_paths(self.lengths, self.neighbours, self.starts, node)
        return self._known[node]


def block_graph(weights: FloatGrid, mask: MaskGrid, side: int) -> BlockGraph:
    """
    Divide a grid into blocks and connect their components.

    Parameters
    ----------
    weights, mask
        As for `cost_to_go`.
    side
        Cells along the side of a block.

    Notes
    -----
    The idea of Botea et al., "Near optimal hierarchical path-finding" (HPA*), 2004, with
    connected components in place of entrances.

    """
    nodes = _label_blocks(mask, side)
    count = int(nodes.max()) + 1
    places, mean = _centroids(nodes, weights, count)
    pairs = [_touching(nodes, side), _touching(nodes.T, side), *_corners(nodes, side)]
    first, second = np.concatenate(pairs, axis=1)
    apart = places[:, first] - places[:, second]
    lengths = np.hypot(apart[0], apart[1]) * 0.5 * (mean[first] + mean[second])
    graph = coo_array(
        (
            np.concatenate([lengths, lengths]),
            (np.concatenate([first, second]), np.concatenate([second, first])),
        ),
        shape=(count, count),
    )
    rows = csr_array(graph)
    blocks = (places // side).astype(np.int32)
    return BlockGraph(side, nodes, mask.shape, blocks, rows.data, rows.indices, rows.indptr)


def corridor(graph: BlockGraph, start: Cell, goal: Cell, room: int) -> MaskGrid:
    """
    Find the cells in which to search for the cheapest path.

    Parameters
    ----------
    graph
        The coarse graph.
    start, goal
        Connected cells.
    room
        The approximate maximum number of cells. The coarse path and its neighbours are always
        included; paths that cost up to 5 % more as long as there is room.

    Returns
    -------
    (rows, columns) mask, in which start and goal are connected.

    """
    from_start, _ = graph.costs_from(start)
    from_goal, before = graph.costs_from(goal)
    node = int(graph.nodes[start])
    way = []
    while node >= 0:
        way.append(node)
        node = int(before[node])
    through = from_start + from_goal
    best = through[way[0]]
    side, nodes = graph.side, graph.nodes
    chosen = np.zeros(len(through), bool)
    blocks = np.zeros((nodes.shape[0] // side, nodes.shape[1] // side), np.uint8)
    for excess in (0.05, 0.02, 0.005, None):
        chosen[:] = False if excess is None else through <= best * (1.0 + excess)
        chosen[way] = True
        chosen[0] = False
        blocks[:] = 0
        blocks[graph.blocks[0][chosen], graph.blocks[1][chosen]] = 1
        wide = cv2.dilate(blocks, np.ones((5, 5) if excess is None else (3, 3), np.uint8))
        if np.count_nonzero(wide) * side * side <= room:
            break
    mask = np.repeat(np.repeat(wide.astype(bool), side, axis=0), side, axis=1)
    mask &= nodes > 0
    return mask[: graph.shape[0], : graph.shape[1]]


def _label_blocks(mask: MaskGrid, side: int) -> npt.NDArray[np.int32]:
    """Label the connected components of each block from 1, with lines between the blocks."""
    rows, columns = (-(-size // side) for size in mask.shape)
    apart = np.zeros((rows, side + 1, columns, side + 1), np.uint8)
    whole = np.zeros((rows * side, columns * side), np.uint8)
    whole[: mask.shape[0], : mask.shape[1]] = mask
    apart[:, :side, :, :side] = whole.reshape(rows, side, columns, side)
    _, labels = cv2.connectedComponents(
        apart.reshape(rows * (side + 1), columns * (side + 1)), connectivity=4, ltype=cv2.CV_32S
    )
    inner = labels.reshape(apart.shape)[:, :side, :, :side]
    nodes: npt.NDArray[np.int32] = np.ascontiguousarray(inner, np.int32).reshape(whole.shape)
    return nodes


def _centroids(
    nodes: npt.NDArray[np.int32], weights: FloatGrid, count: int
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """Compute the (2, count) rows and columns of centroids, and the mean weight of the nodes."""
    # Every other row and column suffices, except for nodes without cells there.
    sparse = nodes[::2, ::2]
    row, column = np.nonzero(sparse)
    row, column = row * 2, column * 2
    missing = np.bincount(nodes[row, column], minlength=count) == 0
    missing[0] = False
    if missing.any():
        more = np.nonzero(missing[nodes])
        row, column = np.concatenate([row, more[0]]), np.concatenate([column, more[1]])
    label = nodes[row, column]
    cells = np.maximum(np.bincount(label, minlength=count), 1)
    sums = [np.bincount(label, each, count) for each in (row, column, weights[row, column])]
    return np.stack(sums[:2]) / cells, sums[2] / cells


def _touching(nodes: npt.NDArray[np.int32], side: int) -> npt.NDArray[np.int32]:
    """Find the (2, N) pairs of nodes that touch across the lower sides of blocks, each once."""
    last = slice(side - 1, -1, side)
    above, below = nodes[last], nodes[side::side]
    there = (above > 0) & (below > 0)
    # A pair mostly repeats along the side of a block.
    there[:, 1:] &= (
        (above[:, 1:] != above[:, :-1]) | (below[:, 1:] != below[:, :-1]) | ~there[:, :-1]
    )
    first, second = above[there], below[there]
    pairs = np.unique(first.astype(np.int64) << 32 | second)
    return np.stack([pairs >> 32, pairs & 0xFFFFFFFF]).astype(np.int32)


def _corners(nodes: npt.NDArray[np.int32], side: int) -> list[npt.NDArray[np.int32]]:
    """Find the (2, N) pairs of nodes that touch across corners of blocks, in both directions."""
    last = slice(side - 1, -1, side)
    above, below = nodes[last], nodes[side::side]
    four = (
        above[:, last],
        above[:, side::side],
        below[:, last],
        below[:, side::side],
    )
    free = (four[0] > 0) & (four[1] > 0) & (four[2] > 0) & (four[3] > 0)
    return [np.stack([four[0][free], four[3][free]]), np.stack([four[1][free], four[2][free]])]

# SPDX-License-Identifier: Apache-2.0
"""
Pose graph optimization: the poses that agree best with the measurements between them.

G. Grisetti, R. Kuemmerle, C. Stachniss and W. Burgard, "A tutorial on graph-based SLAM", 2010:
nonlinear least squares on sparse normal equations, with Levenberg-Marquardt damping. Loop
closures are weighted less the less they agree (Cauchy weights).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.sparse import csc_matrix, diags
from scipy.sparse.linalg import splu
from slam_toolbox_py.poses import compose, FloatArray, relative, wrap

__all__ = ['Edge', 'PoseGraph', 'carried']

_CAUCHY = 3.0
_ITERATIONS = 12
_CONVERGED_M = 2e-4


@dataclass(frozen=True, eq=False)
class Edge:
    """A measurement of one pose in another."""

    first: int
    second: int
    measured: FloatArray
    """(3,) pose of the second node in the first one."""
    information: FloatArray
    """(3, 3) inverse covariance of the measurement in the axes of the second node."""
    is_loop: bool = False
    """Whether it is a loop closure, and so may be wrong."""


class PoseGraph:
    """Poses, of which the first one is fixed, and the measurements between them."""

    def __init__(self) -> None:
        self.poses: FloatArray = np.zeros((0, 3))
        """(N, 3) poses in the map."""
        self.edges: list[Edge] = []

    def add_node(self, pose: FloatArray) -> int:
        """
        Add a pose.

        Parameters
        ----------
        pose
            Pose (3,) in the map.

        Returns
        -------
        int
            The index of the node.

        """
        self.poses = np.concatenate([self.poses, np.reshape(pose, (1, 3))])
        return len(self.poses) - 1

    def add_edge(self, edge: Edge) -> None:
        """
        Add a measurement between two nodes.

        Parameters
        ----------
        edge
            The measurement.

        Raises
        ------
        ValueError
            One of its nodes does not exist.

        """
        if not 0 <= min(edge.first, edge.second) <= max(edge.first, edge.second) < len(self.poses):
            raise ValueError('The edge leads to a node that does not exist.')
        self.edges.append(edge)

    def error_of(self, edge: Edge) -> float:
        """
        Compute the squared Mahalanobis distance between a measurement and the poses.

        Parameters
        ----------
        edge
            The measurement, which need not be part of the graph.

        """
        away = _errors(self.poses, [edge])[0]
        return float(away @ edge.information @ away)

    def optimize(self) -> FloatArray:
        """Move the poses so that they agree best with the measurements; return the old ones."""
        before: FloatArray = self.poses.copy()
        for _ in self.optimizing():
            pass
        return before

    def optimizing(self) -> Iterator[None]:
        """Optimize in steps of one linear solve each; the poses change at the end."""
        edges, poses = list(self.edges), self.poses.copy()
        if len(poses) < 2 or not edges:
            return
        problem = _Problem(edges, len(poses))
        damping, cost = 1e-6, problem.cost(poses)
        for _ in range(_ITERATIONS):
            moved = problem.step(poses, damping)
            yield
            new_cost = problem.cost(moved)
            if new_cost > cost:
                damping = max(damping, 1e-6) * 100.0
                if damping > 1e6:
                    break
                continue
            change = float(np.abs(moved - poses)[:, :2].max())
            poses, cost, damping = moved, new_cost, damping * 0.1
            if change < _CONVERGED_M:
                break
        # Nodes added meanwhile keep their poses relative to the last optimized one.
        self.poses = carried(self.poses, poses)


class _Problem:
    """The measurements of a graph as arrays."""

    def __init__(self, edges: list[Edge], nodes: int) -> None:
        self.first = np.array([each.first for each in edges])
        self.second = np.array([each.second for each in edges])
        self.measured = np.array([each.measured for each in edges])
        self.is_loop = np.array([each.is_loop for each in edges])
        information = np.array([each.information for each in edges])
        self.roots = np.linalg.cholesky(information).transpose(0, 2, 1)
        self.nodes = nodes
        row = 3 * np.arange(len(edges))[:, None, None] + np.arange(3)[None, :, None]
        self.rows = np.concatenate([np.broadcast_to(row, (len(edges), 3, 3)).ravel()] * 2)
        column = np.arange(3)[None, None, :]
        self.columns = np.concatenate(
            [
                np.broadcast_to(3 * node[:, None, None] + column, (len(edges), 3, 3)).ravel()
                for node in (self.first, self.second)
            ]
        )

    def cost(self, poses: FloatArray) -> float:
        """Return the sum of the squared errors, with robust weights for loop closures."""
        squared = (self._whitened(poses) ** 2).sum(axis=1)
        robust = _CAUCHY**2 * np.log1p(squared / _CAUCHY**2)
        return float(np.where(self.is_loop, robust, squared).sum())

    def step(self, poses: FloatArray, damping: float) -> FloatArray:
        """Return the poses after a damped Gauss-Newton step."""
        errors = self._whitened(poses)
        squared = (errors**2).sum(axis=1)
        weights = np.where(self.is_loop, 1.0 / (1.0 + squared / _CAUCHY**2), 1.0)
        values = [
            (self.roots @ each * np.sqrt(weights)[:, None, None]).ravel()
            for each in self._jacobians(poses)
        ]
        jacobian = csc_matrix(
            (np.concatenate(values), (self.rows, self.columns)),
            shape=(3 * len(self.first), 3 * self.nodes),
        )[:, 3:]
        normal = (jacobian.T @ jacobian).tocsc()
        normal = normal + diags(damping * normal.diagonal() + 1e-9, format='csc')
        right = -(jacobian.T @ (errors * np.sqrt(weights)[:, None]).ravel())
        moved: FloatArray = poses.copy()
        # The matrix is symmetric and positive definite: no pivoting is needed.
        factors = splu(
            normal,
            permc_spec='MMD_AT_PLUS_A',
            diag_pivot_thresh=0.0,
            options={'SymmetricMode': True},
        )
        moved[1:] += np.reshape(factors.solve(right), (-1, 3))
        moved[:, 2] = wrap(moved[:, 2])
        return moved

    def _whitened(self, poses: FloatArray) -> FloatArray:
        errors = _differences(poses[self.first], poses[self.second], self.measured)
        whitened: FloatArray = np.einsum('eij,ej->ei', self.roots, errors)
        return whitened

    def _jacobians(self, poses: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the Jacobians of the errors by the first and the second poses, (E, 3, 3)."""
        first, second = poses[self.first], poses[self.second]
        turn = first[:, 2] + self.measured[:, 2]
        cos, sin = np.cos(turn), np.sin(turn)
        by_first = np.zeros((len(turn), 3, 3))
        by_second = np.zeros((len(turn), 3, 3))
        by_second[:, 0, 0], by_second[:, 0, 1] = cos, sin
        by_second[:, 1, 0], by_second[:, 1, 1] = -sin, cos
        by_second[:, 2, 2] = 1.0
        by_first[:, :2, :2] = -by_second[:, :2, :2]
        apart = second[:, :2] - first[:, :2]
        by_first[:, 0, 2] = -sin * apart[:, 0] + cos * apart[:, 1]
        by_first[:, 1, 2] = -cos * apart[:, 0] - sin * apart[:, 1]
        by_first[:, 2, 2] = -1.0
        return by_first, by_second


def _errors(poses: FloatArray, edges: list[Edge]) -> FloatArray:
    first, second = poses[[e.first for e in edges]], poses[[e.second for e in edges]]
    return _differences(first, second, np.array([each.measured for each in edges]))


def _differences(first: FloatArray, second: FloatArray, measured: FloatArray) -> FloatArray:
    """Return the errors of the second poses in the axes of the measured ones, (E, 3)."""
    return relative(measured, relative(first, second))


def carried(current: FloatArray, moved: FloatArray) -> FloatArray:
    """
    Move the first poses of a chain, and carry the others with the last one of them.

    Parameters
    ----------
    current
        (N, 3) all poses before.
    moved
        (M, 3) the new values of the first M poses.

    Returns
    -------
    FloatArray
        (N, 3) all poses; the others keep their poses relative to the last moved one.

    """
    first = len(moved)
    later: npt.NDArray[np.float64] = current[first:]
    if not len(later):
        return moved
    last = relative(current[len(moved) - 1], later)
    return np.concatenate([moved, compose(moved[-1], last)])

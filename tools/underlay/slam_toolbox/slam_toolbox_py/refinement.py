# SPDX-License-Identifier: Apache-2.0
"""
Refine the pose of a scan beyond the grid resolution, and estimate its information matrix.

Gauss-Newton on the distances of the points to their nearest surfaces, with robust weights:
A. Censi, "An ICP variant using a point-to-line metric", ICRA 2008. The guess is included as a
measurement, so the pose follows it in unobservable directions, as along a corridor.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree
from slam_toolbox_py.poses import FloatArray, rotation, wrap
from slam_toolbox_py.scans import Scan

__all__ = ['RefinedMatch', 'Surfaces', 'refine']

_NOISE_M = 0.02
_EFFECTIVE_POINTS = 30.0
_GATES_M = (0.25, 0.2, 0.15, 0.1, 0.1, 0.1, 0.1, 0.1)
_MIN_AGREEMENT = 0.7
_MIN_POINTS = 12
_RESPONSE_M = 0.05
_STILL = np.array([2e-4, 2e-4, 1e-4])


@dataclass(frozen=True)
class RefinedMatch:
    """The pose at which a scan matches best."""

    pose: FloatArray
    """(3,) pose of the scan."""
    information: FloatArray
    """(3, 3) inverse covariance of the pose in its own axes, in 1/m2 and 1/rad2."""
    response: float
    """From 0 to 1: how well the points lie on surfaces with matching normals."""


class Surfaces:
    """
    Reference points with their surface normals, for scan matching.

    Parameters
    ----------
    scans
        Scans and their (3,) poses.

    """

    def __init__(self, scans: list[tuple[Scan, FloatArray]]) -> None:
        turned = [(scan, rotation(pose[2]).T, pose[:2]) for scan, pose in scans]
        self.points = np.concatenate(
            [np.zeros((0, 2)), *(scan.points @ turn + at for scan, turn, at in turned)]
        )
        """(M, 2) in m."""
        self.normals = np.concatenate(
            [np.zeros((0, 2)), *(scan.normals @ turn for scan, turn, _ in turned)]
        )
        """(M, 2) unit vectors; 0 where unknown."""
        self._flat = np.flatnonzero((self.normals != 0.0).any(axis=1))
        self._tree = cKDTree(self.points[self._flat]) if len(self._flat) else None

    def nearest(self, points: FloatArray, within_m: float) -> tuple[FloatArray, FloatArray]:
        """
        Find the nearest points with known surfaces.

        Parameters
        ----------
        points
            Points (N, 2) in m, in the frame of the scans' poses.
        within_m
            The maximum distance, in m.

        Returns
        -------
        tuple of FloatArray
            Points (N, 2), and their normals (N, 2), which are 0 where none is within the distance.

        """
        if self._tree is None:
            return np.zeros_like(points), np.zeros_like(points)
        found = self._tree.query(points, distance_upper_bound=within_m)[1]
        is_found = found < len(self._flat)
        index = self._flat[np.where(is_found, found, 0)]
        return self.points[index], self.normals[index] * is_found[:, None]


def refine(
    seen: Surfaces, scan: Scan, start: FloatArray, guess: FloatArray, trust: FloatArray
) -> RefinedMatch:
    """
    Find the most likely pose of a scan, starting from an initial pose.

    Parameters
    ----------
    seen
        The reference surfaces.
    scan, start
        The scan, and its initial (3,) pose.
    guess, trust
        (3,) pose from another measurement, and its (3, 3) information in the axes of the map.

    """
    pose = start.copy()
    hessian = trust
    for gate in _GATES_M:
        arms, errors, normals, weights = _residuals(seen, scan, pose, gate)
        rows = np.column_stack([normals, normals[:, 1] * arms[:, 0] - normals[:, 0] * arms[:, 1]])
        scale = min(1.0, _EFFECTIVE_POINTS / max(weights.sum(), 1.0)) / _NOISE_M**2
        weighted = rows * (scale * weights)[:, None]
        away = pose - guess
        away[2] = wrap(away[2])
        hessian = weighted.T @ rows + trust
        step = -np.linalg.solve(hessian, weighted.T @ errors + trust @ away)
        pose = pose + step
        pose[2] = wrap(pose[2])
        if (np.abs(step) < _STILL).all() and gate == _GATES_M[-1]:
            break
    axes = np.eye(3)
    axes[:2, :2] = rotation(pose[2])
    information = axes.T @ (hessian if weights.sum() >= _MIN_POINTS else trust) @ axes
    return RefinedMatch(pose, information, fit_of(seen, scan, pose))


def fit_of(seen: Surfaces, scan: Scan, pose: FloatArray) -> float:
    """
    Rate how well a scan matches the reference surfaces.

    Parameters
    ----------
    seen
        The reference surfaces.
    scan, pose
        The scan, and its pose (3,) in the frame of the reference surfaces.

    Returns
    -------
    float
        From 0 to 1: the mean closeness of its points with known normals to surfaces with matching
        normals; 0 if it has none.

    """
    _, errors, _, weights = _residuals(seen, scan, pose, 3.0 * _RESPONSE_M)
    known = (scan.normals != 0.0).any(axis=1).sum()
    fit = np.exp(-0.5 * (errors / _RESPONSE_M) ** 2) * (weights > 0.0)
    return float(fit.sum() / known) if known else 0.0


def _residuals(
    seen: Surfaces, scan: Scan, pose: FloatArray, gate_m: float
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Return the points relative to the position, their errors in m, normals, and weights."""
    turn = rotation(pose[2]).T
    arms = scan.points @ turn
    placed = arms + pose[:2]
    nearest, normals = seen.nearest(placed, gate_m)
    errors = ((placed - nearest) * normals).sum(axis=1)
    agreement = ((scan.normals @ turn) * normals).sum(axis=1)
    weights = (agreement > _MIN_AGREEMENT) / (1.0 + (errors / (2.0 * _NOISE_M)) ** 2)
    return arms, errors, normals, weights

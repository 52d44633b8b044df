# SPDX-License-Identifier: Apache-2.0
"""
Match a scan with others: correlative search of its pose, then refinement beyond the grid.

The search covers all poses in a window (E. Olson, "Real-time correlative scan matching", ICRA
2009): the reference points are smeared to a likelihood grid, and coarse grids, whose cells bound
those of a finer one, narrow the search.

The refinement is Gauss-Newton on the distances of the points to their nearest surfaces, with
robust weights (A. Censi, "An ICP variant using a point-to-line metric", ICRA 2008). The guess is
included as a measurement, so the pose follows it in unobservable directions, as along a corridor.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
import numpy.typing as npt
from scipy.spatial import cKDTree
from slam_toolbox_py.poses import FloatArray, rotation, wrap
from slam_toolbox_py.scans import Scan

__all__ = [
    'CorrelationMatch',
    'CorrelationSettings',
    'RefinedMatch',
    'Surfaces',
    'correlate',
    'refine',
]

_POINTS = 120
_FULL = 255
_KEPT = 256
_COARSEST = 8
_CHUNK = 400_000
IntArray = npt.NDArray[np.int32]

_NOISE_M = 0.02
_EFFECTIVE_POINTS = 30.0
_GATES_M = (0.25, 0.2, 0.15, 0.1, 0.1, 0.1, 0.1, 0.1)
_MIN_AGREEMENT = 0.7
_MIN_POINTS = 12
_RESPONSE_M = 0.05
_STILL = np.array([2e-4, 2e-4, 1e-4])


@dataclass(frozen=True)
class CorrelationSettings:
    """The window of a search, its steps, and the penalty of poses far from the guess."""

    half_window_m: float = 0.25
    half_window_rad: float = 0.349
    resolution_m: float = 0.05
    angle_step_rad: float = 0.0349
    smear_m: float = 0.1
    distance_variance: float = 0.5
    angle_variance: float = 1.0
    minimum_distance_penalty: float = 0.5
    minimum_angle_penalty: float = 0.9


@dataclass(frozen=True)
class CorrelationMatch:
    """The best pose of a search."""

    pose: FloatArray
    """(3,) pose of the scan."""
    response: float
    """The mean likelihood of the points, from 0 to 1."""
    variance_m2: float
    """Variance of the position among poses that fit nearly as well."""


def correlate(
    seen: FloatArray, points: FloatArray, guess: FloatArray, settings: CorrelationSettings
) -> CorrelationMatch:
    """
    Find the pose in a window around a guess at which points best match the reference points.

    Parameters
    ----------
    seen
        (M, 2) points in m, in the frame of the guess.
    points
        (N, 2) points of the scan in its own frame, in m.
    guess
        (3,) pose of the scan.
    settings
        The window and its steps.

    """
    points = points[:: max(1, -(-len(points) // _POINTS))]
    if not len(points) or not len(seen):
        return CorrelationMatch(guess.copy(), 0.0, float('inf'))
    reach = int(np.ceil(settings.half_window_m / settings.resolution_m))
    count = int(np.ceil(settings.half_window_rad / settings.angle_step_rad))
    angles = np.linspace(-1.0, 1.0, 2 * count + 1) * settings.half_window_rad
    step = 1 if reach <= _COARSEST else _COARSEST
    field, corner = _likelihoods(seen, settings, 2 * (reach + step) + 2)
    base = _cells_of(points, guess, angles, corner, field.shape, reach + step, settings)
    axis = np.arange(-reach, reach + 1, step)
    candidates = np.stack(
        [each.ravel() for each in np.meshgrid(np.arange(len(angles)), axis, axis, indexing='ij')]
    ).astype(np.int32)
    while True:
        turn, down, right = candidates
        likelihood = _score(_bounds(field, step), base, turn, down, right) / _FULL
        disliked = _penalty(angles[turn], right, down, settings)
        if step == 1:
            break
        kept = np.argsort(-likelihood * disliked)[:_KEPT]
        step //= 2
        corners = step * np.array([[0, 0, 0, 0], [0, 0, 1, 1], [0, 1, 0, 1]], dtype=np.int32)
        candidates = (candidates[:, kept, None] + corners[:, None]).reshape(3, -1)
    score = likelihood * disliked
    best = int(np.argmax(score))
    is_close = score >= score[best] - 0.1 * max(score[best], 1e-6)
    weight = score[is_close] / score[is_close].sum() if score[best] > 0.0 else 0.0
    offsets = settings.resolution_m * np.stack([right, down], axis=1)
    spread = (weight * ((offsets - offsets[best])[is_close] ** 2).sum(axis=1)).sum()
    pose = np.append(guess[:2] + offsets[best], wrap(guess[2] + angles[turn[best]]))
    return CorrelationMatch(pose, float(likelihood[best]), float(spread))


def _likelihoods(
    seen: FloatArray, settings: CorrelationSettings, margin: int
) -> tuple[npt.NDArray[np.uint8], FloatArray]:
    """Return the likelihood grid, with a margin of zeros, and its corner in m."""
    smear = int(np.ceil(3.0 * settings.smear_m / settings.resolution_m))
    corner = seen.min(axis=0) - (margin + smear) * settings.resolution_m
    cells = np.floor((seen - corner) / settings.resolution_m).astype(np.intp)
    columns, rows = cells.max(axis=0) + margin + smear + 1
    empty = np.full((rows, columns), 255, dtype=np.uint8)
    empty[cells[:, 1], cells[:, 0]] = 0
    distance = cv2.distanceTransform(empty, cv2.DIST_L2, 3) * settings.resolution_m
    distance[distance > 3.0 * settings.smear_m] = np.inf
    near = np.exp(-0.5 * (distance / settings.smear_m) ** 2)
    return np.rint(near * _FULL).astype(np.uint8), corner


def _cells_of(
    points: FloatArray,
    guess: FloatArray,
    angles: FloatArray,
    corner: FloatArray,
    shape: tuple[int, ...],
    reach: int,
    settings: CorrelationSettings,
) -> tuple[IntArray, int]:
    """Return the flat cell indices of the points at each angle, and the row length."""
    turns = np.stack([rotation(guess[2] + angle) for angle in angles])
    placed = np.einsum('aij,pj->api', turns, points) + guess[:2]
    cells = np.floor((placed - corner) / settings.resolution_m)
    columns = np.clip(cells[..., 0], reach, shape[1] - 1 - reach).astype(np.int32)
    rows = np.clip(cells[..., 1], reach, shape[0] - 1 - reach).astype(np.int32)
    return rows * np.int32(shape[1]) + columns, shape[1]


def _bounds(field: npt.NDArray[np.uint8], step: int) -> npt.NDArray[np.uint8]:
    """Return the maximum likelihood in the square of `step` cells that starts at each cell."""
    if step == 1:
        return field.ravel()
    kernel = np.ones((step, step), dtype=np.uint8)
    highest: npt.NDArray[np.uint8] = np.asarray(cv2.dilate(field, kernel, anchor=(0, 0)))
    return highest.ravel()


def _score(
    field: npt.NDArray[np.uint8],
    base: tuple[IntArray, int],
    turn: IntArray,
    down: IntArray,
    right: IntArray,
) -> FloatArray:
    """Return the mean value of the points for each candidate."""
    cells, columns = base
    shift = down * np.int32(columns) + right
    each = max(1, _CHUNK // cells.shape[1])
    parts = [slice(i, i + each) for i in range(0, len(turn), each)]
    sums = [
        field[cells[turn[part]] + shift[part, None]].sum(axis=1, dtype=np.int32) for part in parts
    ]
    mean: FloatArray = np.concatenate(sums) / cells.shape[1]
    return mean


def _penalty(
    angle: FloatArray, right: IntArray, down: IntArray, settings: CorrelationSettings
) -> FloatArray:
    """Return the penalty factors, up to 1, for the distance of candidates from the guess."""
    distance2 = (right.astype(float) ** 2 + down.astype(float) ** 2) * settings.resolution_m**2
    by_distance = np.exp(-0.5 * distance2 / settings.distance_variance)
    by_angle = np.exp(-0.5 * angle**2 / settings.angle_variance)
    factors: FloatArray = np.maximum(by_distance, settings.minimum_distance_penalty) * np.maximum(
        by_angle, settings.minimum_angle_penalty
    )
    return factors


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

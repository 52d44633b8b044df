# SPDX-License-Identifier: Apache-2.0
"""
How are parameters found that earn most, without gradients? By covariance matrix adaptation.

The algorithm is CMA-ES with rank-one and rank-mu update and its usual constants: N. Hansen and
A. Ostermeier, "Completely Derandomized Self-Adaptation in Evolution Strategies", Evolutionary
Computation 9(2), 2001; N. Hansen, "The CMA Evolution Strategy: A Tutorial", arXiv:1604.00772.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from io import BytesIO
from pathlib import Path
from zipfile import BadZipFile
import zlib

from humanoid_common.errors import UserError
from humanoid_control.backends import Array
from humanoid_simulation.files import replace_file
import numpy as np


@dataclass(eq=False)
class SearchState:
    """
    What a search has learnt: a normal distribution of n parameters, and the paths of its mean.

    The covariance of the distribution is `sigma` squared times `covariance`.
    """

    mean: Array
    """(n,)"""
    sigma: Array
    """() step size"""
    covariance: Array
    """(n, n)"""
    covariance_path: Array
    """(n,)"""
    sigma_path: Array
    """(n,)"""
    generation: Array
    """() number of generations so far"""

    @classmethod
    def around(cls, mean: Array, sigma: float) -> SearchState:
        """
        Begin a search.

        Parameters
        ----------
        mean
            Parameters (n,) to begin with.
        sigma
            Standard deviation of each of them.

        """
        zero = np.zeros(len(mean))
        return cls(mean.copy(), np.array(sigma), np.eye(len(mean)), zero, zero.copy(), np.array(0))

    @classmethod
    def load(cls, path: Path, size: int) -> SearchState:
        """
        Read a checkpoint.

        Parameters
        ----------
        path
            A file that `save` has written.
        size
            The number n of parameters.

        Raises
        ------
        OSError
            The file cannot be read.
        UserError
            It is not a checkpoint of a search for so many parameters.

        """
        try:
            with np.load(BytesIO(path.read_bytes())) as stored:
                state = cls(**{each.name: stored[each.name] for each in fields(cls)})
            state.check(size)
        except (
            AttributeError, BadZipFile, EOFError, KeyError, NotImplementedError, OSError,
            TypeError, ValueError, zlib.error,
        ) as error:  # fmt: skip
            if isinstance(error, OSError) and error.errno is not None:
                raise
            raise UserError(f"'{path}' is not a checkpoint of a search. Move it away.") from None
        return state

    def save(self, path: Path) -> None:
        """
        Write a checkpoint; the one before stays until this one is complete.

        Parameters
        ----------
        path
            The file, with the suffix .npz.

        Raises
        ------
        SimulationError
            It cannot be written, as on a full disk.

        """
        content = BytesIO()
        np.savez(content, **{each.name: getattr(self, each.name) for each in fields(self)})
        replace_file(path, content.getvalue())

    def check(self, size: int) -> None:
        """
        Check that all values are finite numbers, as many as there have to be.

        Parameters
        ----------
        size
            The number n of parameters.

        Raises
        ------
        ValueError
            A value is wrong; the message is its name.

        """
        wanted = dict.fromkeys(('mean', 'covariance_path', 'sigma_path'), (size,))
        shapes = {'sigma': (), 'generation': (), 'covariance': (size, size), **wanted}
        for name, shape in shapes.items():
            value = getattr(self, name)
            if value.shape != shape or not np.isfinite(value).all():
                raise ValueError(name)
        if self.sigma <= 0.0 or self.generation < 0 or self.generation.dtype.kind != 'i':
            raise ValueError('sigma or generation')


class Search:
    """
    A search for the parameters with the largest value.

    Parameters
    ----------
    state
        Where it begins, or goes on.
    seed
        Seed of the candidates: a search that goes on draws those that it would have drawn.
    size
        Number of candidates in a generation.

    """

    def __init__(self, state: SearchState, seed: int, size: int) -> None:
        self.state, self._seed, self.size = state, seed, size
        n, parents = len(state.mean), size // 2
        weights = np.log((size + 1) / 2) - np.log(np.arange(1, parents + 1))
        self._weights = weights / weights.sum()
        mass = 1.0 / float(self._weights @ self._weights)
        self._mass = mass
        self._c_sigma = (mass + 2) / (n + mass + 5)
        self._damping = 1 + 2 * max(0.0, np.sqrt((mass - 1) / (n + 1)) - 1) + self._c_sigma
        self._c_path = (4 + mass / n) / (n + 4 + 2 * mass / n)
        self._c_one = 2 / ((n + 1.3) ** 2 + mass)
        self._c_mu = min(1 - self._c_one, 2 * (mass - 2 + 1 / mass) / ((n + 2) ** 2 + mass))
        self._usual_length = np.sqrt(n) * (1 - 1 / (4 * n) + 1 / (21 * n * n))

    def candidates(self) -> Array:
        """Draw the candidates of the present generation, (size, n): the same ones each time."""
        state = self.state
        random = np.random.default_rng([self._seed, int(state.generation)])
        drawn = random.standard_normal((self.size, len(state.mean)))
        widths, axes = self._ellipsoid()
        steps: Array = (drawn * widths) @ axes.T
        return state.mean + state.sigma * steps

    def learn(self, candidates: Array, values: Array) -> None:
        """
        Move the distribution towards the candidates that are worth most.

        Parameters
        ----------
        candidates
            Those of this generation (size, n).
        values
            What each is worth (size,).

        """
        state, best = self.state, np.argsort(-values)[: len(self._weights)]
        steps = (candidates[best] - state.mean) / state.sigma
        step = self._weights @ steps
        widths, axes = self._ellipsoid()
        white = axes @ ((axes.T @ step) / widths)
        c = self._c_sigma
        state.sigma_path = (1 - c) * state.sigma_path + np.sqrt(c * (2 - c) * self._mass) * white
        length = np.linalg.norm(state.sigma_path)
        settled = np.sqrt(1 - (1 - c) ** (2 * (int(state.generation) + 1)))
        moves = length / settled < (1.4 + 2 / (len(step) + 1)) * self._usual_length
        c = self._c_path
        state.covariance_path = (1 - c) * state.covariance_path
        state.covariance_path += moves * np.sqrt(c * (2 - c) * self._mass) * step
        lost = (1 - moves) * self._c_one * c * (2 - c)
        state.covariance = (
            (1 - self._c_one - self._c_mu + lost) * state.covariance
            + self._c_one * np.outer(state.covariance_path, state.covariance_path)
            + self._c_mu * (steps.T * self._weights) @ steps
        )
        state.mean = state.mean + state.sigma * step
        growth = self._c_sigma / self._damping * (length / self._usual_length - 1)
        state.sigma = state.sigma * np.exp(growth)
        state.generation = state.generation + 1

    def _ellipsoid(self) -> tuple[Array, Array]:
        """Return the widths (n,) of the distribution, and its axes (n, n) as columns."""
        covariance = self.state.covariance
        squares, axes = np.linalg.eigh((covariance + covariance.T) / 2)
        return np.sqrt(np.maximum(squares, 1e-20)), axes

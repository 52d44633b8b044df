# SPDX-License-Identifier: Apache-2.0
"""From varied conditions to the list of runs: grid, random, Latin hypercube."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import product
from typing import Any

from humanoid_simulation.sweep.conditions import conditions_of, Run
import numpy as np

GRID, RANDOM, LATIN_HYPERCUBE = 'grid', 'random', 'latin_hypercube'
METHODS = (GRID, RANDOM, LATIN_HYPERCUBE)
_CONDITIONS_STREAM = 1
"""Stream of random numbers for conditions; those of the walk itself have other numbers."""


@dataclass(frozen=True)
class Choices:
    """A condition with some values; with a single one, it is fixed."""

    options: tuple[Any, ...]

    @property
    def is_varied(self) -> bool:
        """Whether there is more than one value."""
        return len(self.options) > 1

    def grid(self) -> list[Any]:
        """Return all values."""
        return [*self.options]

    def draw(self, random: np.random.Generator) -> Any:
        """
        Draw a value; all are equally likely.

        Parameters
        ----------
        random
            Source of random numbers.

        """
        return self.options[int(random.integers(len(self.options)))]

    def at(self, share: float) -> Any:
        """
        Return the value at a share of the list.

        Parameters
        ----------
        share
            From 0 to below 1.

        """
        return self.options[int(share * len(self.options))]


@dataclass(frozen=True)
class Range:
    """A condition that varies between two numbers, which are included if it is whole."""

    low: float
    high: float
    steps: int = 0
    """Number of values in a grid."""
    is_whole: bool = False
    is_varied = True

    def grid(self) -> list[Any]:
        """Return evenly spaced values; whole ones are rounded, and each appears once."""
        values = np.linspace(self.low, self.high, self.steps).tolist()
        return sorted({round(value) for value in values}) if self.is_whole else values

    def draw(self, random: np.random.Generator) -> Any:
        """
        Draw a value from the uniform distribution.

        Parameters
        ----------
        random
            Source of random numbers.

        """
        if self.is_whole:
            return int(random.integers(round(self.low), round(self.high) + 1))
        return float(random.uniform(self.low, self.high))

    def at(self, share: float) -> Any:
        """
        Return the value at a share of the range.

        Parameters
        ----------
        share
            From 0 to below 1.

        """
        if self.is_whole:
            return round(self.low) + int(share * (round(self.high) - round(self.low) + 1))
        return self.low + share * (self.high - self.low)


Factor = Choices | Range


@dataclass(frozen=True)
class Sampling:
    """How conditions are chosen from the values that they may have."""

    method: str = GRID
    samples: int = 1
    """Number of draws; a grid has as many points as it has."""
    first_seed: int = 0
    seeds: int = 1
    """Runs of each choice of conditions, with seeds of their own."""

    def runs(self, factors: Mapping[str, Factor]) -> list[Run]:
        """
        List the runs; the same arguments give the same list, and equal runs appear once.

        Parameters
        ----------
        factors
            The values of conditions, by name and in order; others have their defaults.

        Raises
        ------
        ParameterError
            Values contradict each other.
        SimulationError
            The file of a scene cannot be found.

        """
        runs: dict[str, Run] = {}
        for values in self._values(factors):
            conditions = conditions_of(values)
            run = Run(conditions, conditions.digest)
            runs.setdefault(run.key, run)
        return [*runs.values()]

    def _values(self, factors: Mapping[str, Factor]) -> Iterator[dict[str, Any]]:
        """
        Yield the values of the conditions of each run.

        All points of a grid have the same seeds, so that differences come from the conditions.
        """
        points = {GRID: _grid, RANDOM: self._random, LATIN_HYPERCUBE: self._hypercube}
        for number, values in enumerate(points[self.method](factors)):
            first = self.first_seed + (0 if self.method == GRID else number * self.seeds)
            for seed in range(first, first + self.seeds):
                yield values | {'seed': seed}

    def _random(self, factors: Mapping[str, Factor]) -> Iterator[dict[str, Any]]:
        """Draw each sample from a generator of its own: more samples keep the first ones."""
        for number in range(self.samples):
            random = np.random.default_rng([self.first_seed + number, _CONDITIONS_STREAM])
            yield {
                name: factor.draw(random) if factor.is_varied else factor.grid()[0]
                for name, factor in factors.items()
            }

    def _hypercube(self, factors: Mapping[str, Factor]) -> Iterator[dict[str, Any]]:
        """
        Draw a Latin hypercube: each of n equal slices of each condition is drawn from once.

        McKay, Beckman and Conover, "A Comparison of Three Methods for Selecting Values of Input
        Variables in the Analysis of Output from a Computer Code", Technometrics 21 (1979).
        """
        from scipy.stats.qmc import LatinHypercube  # takes a second to import

        random = np.random.default_rng([self.first_seed, _CONDITIONS_STREAM])
        varied = [name for name, factor in factors.items() if factor.is_varied]
        shares = LatinHypercube(max(len(varied), 1), seed=random).random(self.samples)
        for row in shares.tolist():
            share = dict(zip(varied, row))
            yield {name: factor.at(share.get(name, 0.0)) for name, factor in factors.items()}


def _grid(factors: Mapping[str, Factor]) -> Iterator[dict[str, Any]]:
    """Yield all combinations; the last condition varies fastest."""
    for values in product(*(factor.grid() for factor in factors.values())):
        yield dict(zip(factors, values))

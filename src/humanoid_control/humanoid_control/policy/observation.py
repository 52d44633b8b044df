# SPDX-License-Identifier: Apache-2.0
"""What a policy observes: the terms of its file in their order, scaled, with a history."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Mapping, Sequence

from humanoid_control.backends import Array
from humanoid_control.policy.policy_file import BY_TERM, PolicyFile
import numpy as np
from numpy.typing import NDArray

Vector = NDArray[np.float32]


class ObservationHistory:
    """
    Builds the input of the network, and remembers what it observed before.

    Parameters
    ----------
    file
        The policy file, with the terms and the length of the history.

    """

    def __init__(self, file: PolicyFile) -> None:
        self._terms, self._by_term = file.terms, file.history_order == BY_TERM
        self._clip = file.observation_clip
        self._steps: deque[list[Array]] = deque(maxlen=file.history_length)

    def reset(self) -> None:
        """Forget the history; the next observation then fills it."""
        self._steps.clear()

    def add(self, values: Mapping[str, Array]) -> Vector:
        """
        Add the observation of a step, and build the input of the network.

        Parameters
        ----------
        values
            The values of each term, in SI units.

        Returns
        -------
        Vector
            The input (1, size): the oldest step first, within each term or as a whole.

        """
        step = [
            np.clip(
                np.clip(values[term.name], term.lower, term.upper) * term.scale,
                -self._clip,
                self._clip,
            )
            for term in self._terms
        ]
        self._steps.append(step)
        while len(self._steps) < (self._steps.maxlen or 0):
            self._steps.append(step)
        rows: Iterable[Sequence[Array]] = self._steps
        if self._by_term:
            rows = zip(*self._steps, strict=True)
        parts = [part for row in rows for part in row]
        return np.concatenate(parts).astype(np.float32)[None]

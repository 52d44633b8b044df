# SPDX-License-Identifier: Apache-2.0
"""Reassembly of samples that are too large for one datagram (8.4.14.1)."""

from __future__ import annotations

from ros2cli.rtps.parameters import Parameters
from ros2cli.rtps.wire import Data, Fragment

NO_QOS = Parameters({}, '<')
MAX_SAMPLE_BYTES = 1 << 24


class Fragments:
    """Fragments of a writer's latest sample; if one is lost, all are requested again."""

    def __init__(self) -> None:
        """Start without fragments."""
        self._number = 0
        self._parts: dict[int, bytes] = {}
        self._missing = 0

    def add(self, fragment: Fragment) -> Data | None:
        """
        Add a fragment, and reassemble the sample when it is complete.

        Parameters
        ----------
        fragment
            A fragment of a sample; the fragments of the previous sample are dropped when it
            belongs to another one.

        Returns
        -------
        Data or None
            The whole sample if this was the last missing fragment.

        Raises
        ------
        ValueError
            The declared sample size is larger than 16 MiB.

        """
        if fragment.size > MAX_SAMPLE_BYTES:
            raise ValueError(f'a sample of {fragment.size} bytes')
        if fragment.number != self._number:
            self._number, self._missing = fragment.number, fragment.size
            self._parts.clear()
        if fragment.payload and fragment.start not in self._parts:
            self._parts[fragment.start] = fragment.payload
            self._missing -= len(fragment.payload)
        if self._missing > 0:
            return None
        self._number = 0
        payload = b''.join(part for _, part in sorted(self._parts.items()))[: fragment.size]
        self._parts.clear()
        return Data(fragment.reader, fragment.writer, fragment.number, payload, NO_QOS, False)

# SPDX-License-Identifier: Apache-2.0
"""Put samples together that are too large for one datagram (8.4.14.1)."""

from __future__ import annotations

from ros2cli.rtps.parameters import Parameters
from ros2cli.rtps.wire import Data, Fragment

NO_QOS = Parameters({}, '<')
MAX_SAMPLE_BYTES = 1 << 24


class Fragments:
    """The parts of a writer's latest sample; if one of them is lost, all are asked for again."""

    def __init__(self) -> None:
        """Have no part."""
        self._number = 0
        self._parts: dict[int, bytes] = {}
        self._missing = 0

    def add(self, fragment: Fragment) -> Data | None:
        """
        Add a fragment, and reassemble the sample when it is complete.

        Parameters
        ----------
        fragment
            A part of a sample; that of another sample than the last drops the parts of the last
            one.

        Returns
        -------
        Data or None
            The whole sample if this was the last part that was missing.

        Raises
        ------
        ValueError
            The sample is said to be larger than 16 MiB.

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

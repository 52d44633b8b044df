# SPDX-License-Identifier: Apache-2.0
"""Playback of a recording with seeking."""

from __future__ import annotations

from collections.abc import Callable, Iterator
import time
from typing import Protocol

from ros2bag.api.pacing import Pacing
from ros2bag.storage.latched import RecordedMessage

__all__ = ['Playback', 'Source']

STEP_NS = 50_000_000
SLICE_NS = 20_000_000
LEAD_NS = 300_000_000
"""After a seek, messages from this interval before the target are published at once as context."""
SILENCE_NS = 150_000_000
"""Pause after a backward jump, during which subscribers clear their outdated state."""


class Source(Protocol):
    """A recording to play."""

    start_ns: int
    end_ns: int

    def messages(self, start_ns: int) -> Iterator[RecordedMessage]:
        """
        Yield the messages to play, in order of time.

        Parameters
        ----------
        start_ns
            The recorded start time, in ns; may precede the start of the recording.

        """

    def latched(self, start_ns: int, end_ns: int) -> Iterator[RecordedMessage]:
        """
        Yield the latched messages in a time span.

        Parameters
        ----------
        start_ns, end_ns
            Recorded times, in ns; the end is exclusive.

        """


class Playback:
    """
    Publishes recorded messages when they are due, with support for seeking.

    Playback begins at the start of the recording, after a short silence. Call `step` in a loop.

    Parameters
    ----------
    source
        The recording.
    publish
        Publishes a message.
    now_ns
        A monotonic clock, in ns.

    Attributes
    ----------
    is_looping
        Whether to restart at the end.
    is_paused
        Whether playback is paused.
    is_ended
        Whether the end was reached.

    """

    def __init__(
        self,
        source: Source,
        publish: Callable[[RecordedMessage], None],
        now_ns: Callable[[], int] = time.monotonic_ns,
    ) -> None:
        self._source = source
        self._publish = publish
        self._now_ns = now_ns
        self._pacing = Pacing(source.start_ns, 1.0, now_ns)
        self.is_looping = False
        self.is_paused = False
        self.is_ended = False
        self.jumps = 0
        """The number of backward jumps in recorded time; the start counts as the first."""
        self._silent_until_ns = 0
        self._target_ns = source.start_ns
        self._messages: Iterator[RecordedMessage] = iter(())
        self._next: RecordedMessage | None = None
        self._jump_back(source.start_ns)

    @property
    def rate(self) -> float:
        """Return the playback rate, in recorded seconds per second."""
        return self._pacing.rate

    @property
    def position_ns(self) -> int:
        """Return the current recorded time."""
        start_ns, end_ns = self._source.start_ns, self._source.end_ns
        if self._next is None:
            return end_ns
        now_ns = self._pacing.recorded_now_ns
        return max(start_ns, min(now_ns, max(self._next.log_ns, self._target_ns), end_ns))

    def pause(self) -> None:
        """Pause playback."""
        if not self.is_paused:
            self.is_paused = True
            self._pacing.hold()

    def go_on(self) -> None:
        """Resume playback, from the start if the end was reached."""
        self.is_paused = False
        if self.is_ended:
            self._jump_back(self._source.start_ns)
        elif not self._is_silent():
            self._pacing.release()

    def set_rate(self, rate: float) -> None:
        """
        Set the playback rate.

        Parameters
        ----------
        rate
            Recorded seconds per second; positive, may be infinite.

        """
        self._pacing.set_rate(rate)

    def jump_to(self, recorded_ns: int) -> None:
        """
        Seek to a recorded time.

        Messages recorded in the 0.3 s before that time are published at once as context; on a
        forward seek, skipped latched messages are published as well.

        Parameters
        ----------
        recorded_ns
            The recorded time, in ns; clamped to the recording.

        """
        recorded_ns = max(self._source.start_ns, min(recorded_ns, self._source.end_ns))
        here_ns = self.position_ns
        if recorded_ns < here_ns:
            self._jump_back(recorded_ns)
            return
        for message in self._source.latched(here_ns, max(here_ns, recorded_ns - LEAD_NS)):
            self._publish(message)
        self._open(recorded_ns, max(here_ns, recorded_ns - LEAD_NS))

    def step(self) -> int:
        """Publish due messages, and return the time until the next call, in ns."""
        now_ns = self._now_ns()
        if now_ns < self._silent_until_ns:
            return min(STEP_NS, self._silent_until_ns - now_ns)
        if self._is_silent():
            self._silent_until_ns = 0
            self._pacing.jump_to(self._target_ns)
            if not self.is_paused:
                self._pacing.release()
        return self._publish_due(now_ns + SLICE_NS)

    def _publish_due(self, until_ns: int) -> int:
        """Publish due messages for a limited time, so that commands are still processed."""
        while self._next is not None:
            wait_ns = self._wait_ns(self._next)
            if wait_ns > 0:
                return min(STEP_NS, wait_ns)
            self._publish(self._next)
            self._next = next(self._messages, None)
            if self._now_ns() > until_ns:
                return 0
        if self.is_looping and not self.is_paused:
            self._jump_back(self._source.start_ns)
        elif not self.is_ended:
            self.is_ended = True
            self._pacing.hold()
        return STEP_NS

    def _wait_ns(self, message: RecordedMessage) -> int:
        if message.log_ns <= self._target_ns:
            return 0
        return STEP_NS if self.is_paused else self._pacing.wait_ns(message.log_ns)

    def _is_silent(self) -> bool:
        return self._silent_until_ns > 0

    def _jump_back(self, recorded_ns: int) -> None:
        self.jumps += 1
        self._silent_until_ns = self._now_ns() + SILENCE_NS
        self._open(recorded_ns, recorded_ns - LEAD_NS)
        self._pacing.hold()

    def _open(self, recorded_ns: int, from_ns: int) -> None:
        """Start to read at a time; messages before the target time are due at once."""
        self.is_ended = False
        self._target_ns = recorded_ns
        self._messages = self._source.messages(from_ns)
        self._next = next(self._messages, None)
        self._pacing.jump_to(recorded_ns)

# SPDX-License-Identifier: Apache-2.0
"""Evaluate the shared memory for messages between processes of this machine."""

from __future__ import annotations

from collections.abc import Iterator

from ros2doctor.api.finding import Finding, Severity
from ros2doctor.facts.shared_memory import SharedMemory

ENOUGH_BYTES = 64 * 1000 * 1000
TOO_MANY_BYTES = 256 * 1000 * 1000
CLEAN_UP = 'for l in /dev/shm/fastrtps_[0-9a-f]*_el; do flock -n "$l" rm -f "$l" "${l%_el}"; done'


def shared_memory_findings(facts: SharedMemory | None) -> Iterator[Finding]:
    """
    Report shared memory that is missing, almost full, or occupied by killed processes.

    Parameters
    ----------
    facts
        The state of /dev/shm; None if it does not exist or cannot be written.

    Yields
    ------
    Finding
        At most one warning.

    """
    if facts is None:
        yield _too_little('is missing or cannot be written', 'sudo mount -t tmpfs tmpfs /dev/shm')
    elif facts.free < ENOUGH_BYTES:
        mend = CLEAN_UP if facts.orphans else 'end nodes that are not needed'
        yield _too_little(f'has {facts.free // 10**6} MB left', mend)
    elif facts.orphan_bytes > TOO_MANY_BYTES:
        yield Finding(
            Severity.WARNING,
            f'/dev/shm holds {facts.orphan_bytes // 10**6} MB of {facts.orphans} processes that '
            'were killed',
            'it is memory that nobody uses, and stays taken until the machine starts anew',
            CLEAN_UP,
        )


def _too_little(state: str, mend: str) -> Finding:
    return Finding(
        Severity.WARNING,
        f'/dev/shm {state}',
        'messages between processes of this machine go through it, several MB a node: nodes '
        'fail to start, or large messages get lost',
        f'{mend}; in a container: docker run --shm-size=1g',
    )

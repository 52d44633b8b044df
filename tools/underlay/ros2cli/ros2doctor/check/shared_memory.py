# SPDX-License-Identifier: Apache-2.0
"""Check the shared memory for messages between processes of this machine."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
import fcntl
import os
from pathlib import Path
import shutil

from ros2doctor.api.extension import Finding, Severity

FOLDER = Path('/dev/shm')
LOCKS = 'fastrtps_[0-9a-f]*_el'  # locks of segments; those of ports differ
LOCK_SUFFIX = '_el'
BLOCK_BYTES = 512
ENOUGH_BYTES = 64 * 1000 * 1000
TOO_MANY_BYTES = 256 * 1000 * 1000
CLEAN_UP = 'for l in /dev/shm/fastrtps_[0-9a-f]*_el; do flock -n "$l" rm -f "$l" "${l%_el}"; done'


@dataclass(frozen=True)
class SharedMemory:
    """
    Shared memory usage, in bytes.

    :param free: the free space
    :param orphans: how many segments belong to processes that were killed
    :param orphan_bytes: the memory that these still occupy
    """

    free: int
    orphans: int = 0
    orphan_bytes: int = 0


def read_shared_memory(folder: Path = FOLDER) -> SharedMemory | None:
    """
    Measure the shared memory available to Fast DDS, and the orphans of killed processes.

    Parameters
    ----------
    folder
        The mount point of the shared memory.

    Returns
    -------
    SharedMemory or None
        None if the folder does not exist or cannot be written.

    """
    if not os.access(folder, os.W_OK):
        return None
    orphans = [lock for lock in sorted(folder.glob(LOCKS)) if _is_orphan(lock)]
    segments = [lock.with_name(lock.name.removesuffix(LOCK_SUFFIX)) for lock in orphans]
    return SharedMemory(
        shutil.disk_usage(folder).free, len(orphans), sum(_bytes(each) for each in segments)
    )


def _is_orphan(lock: Path) -> bool:
    """Whether no process holds the lock; Fast DDS locks each segment as long as it is used."""
    try:
        with lock.open('rb') as stream:
            fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return True


def _bytes(segment: Path) -> int:
    try:
        return segment.stat().st_blocks * BLOCK_BYTES
    except OSError:
        return 0


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
        mend = CLEAN_UP if facts.orphans else 'stop nodes that are not needed'
        yield _too_little(f'has {facts.free // 10**6} MB left', mend)
    elif facts.orphan_bytes > TOO_MANY_BYTES:
        yield Finding(
            Severity.WARNING,
            f'/dev/shm holds {facts.orphan_bytes // 10**6} MB of {facts.orphans} processes that '
            'were killed',
            'this memory is unused, but stays allocated until the machine restarts',
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

# SPDX-License-Identifier: Apache-2.0
"""The shared memory that transports messages between processes of this machine."""

from __future__ import annotations

from dataclasses import dataclass
import fcntl
import os
from pathlib import Path
import shutil

FOLDER = Path('/dev/shm')
LOCKS = 'fastrtps_[0-9a-f]*_el'  # locks of segments; those of ports differ
LOCK_SUFFIX = '_el'
BLOCK_BYTES = 512


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

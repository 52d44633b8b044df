# SPDX-License-Identifier: Apache-2.0
"""The formats of files and messages that can be read and written."""

from __future__ import annotations

from ros2bag.storage import BagError
from ros2bag.storage.bag_reader import READABLE
from rosbag2_py._storage import ConverterOptions, StorageOptions

__all__ = [
    'check_formats',
    'get_registered_compressors',
    'get_registered_readers',
    'get_registered_serializers',
    'get_registered_writers',
]

WRITTEN, SERIALIZATION = 'mcap', 'cdr'


def get_registered_readers() -> set[str]:
    """Return the formats of files that can be read."""
    return {*READABLE}


def get_registered_writers() -> set[str]:
    """Return the formats of files that can be written."""
    return {WRITTEN}


def get_registered_compressors() -> set[str]:
    """Return the compressions of whole files and messages: none, MCAP compresses its chunks."""
    return set()


def get_registered_serializers() -> set[str]:
    """Return the formats of serialized messages."""
    return {SERIALIZATION}


def check_formats(
    storage: StorageOptions, converter: ConverterOptions | None, known: set[str]
) -> None:
    """
    Check that a bag has formats that are supported.

    Parameters
    ----------
    storage, converter
        The options of a reader or writer.
    known
        The formats of files that it can read or write.

    Raises
    ------
    BagError
        A format is not supported; the message says which one is.

    """
    if storage.storage_id not in ('', *known):
        raise BagError(
            f"Bags in the format '{storage.storage_id}' are not supported here, only in "
            f'{" or ".join(sorted(known))}. Existing ones are converted with: '
            'rosbags-convert --src OLD --dst NEW --dst-storage mcap'
        )
    given = converter or ConverterOptions()
    for name in (given.input_serialization_format, given.output_serialization_format):
        if name not in ('', SERIALIZATION):
            raise BagError(f"Messages are serialized as '{SERIALIZATION}', not as '{name}'.")

# SPDX-License-Identifier: Apache-2.0
"""Read and write bags in Python, message by message."""

from typing import NoReturn

from rosbag2_py._formats import (
    get_registered_compressors,
    get_registered_readers,
    get_registered_serializers,
    get_registered_writers,
)
from rosbag2_py._reader import Info, SequentialReader
from rosbag2_py._storage import (
    BagMetadata,
    ConverterOptions,
    FileInformation,
    ReadOrder,
    ReadOrderSortBy,
    StorageFilter,
    StorageOptions,
    TopicInformation,
    TopicMetadata,
)
from rosbag2_py._writer import Reindexer, SequentialWriter

__all__ = [
    'BagMetadata',
    'ConverterOptions',
    'FileInformation',
    'Info',
    'ReadOrder',
    'ReadOrderSortBy',
    'Reindexer',
    'SequentialCompressionReader',
    'SequentialReader',
    'SequentialWriter',
    'StorageFilter',
    'StorageOptions',
    'TopicInformation',
    'TopicMetadata',
    'get_registered_compressors',
    'get_registered_readers',
    'get_registered_serializers',
    'get_registered_writers',
]

SequentialCompressionReader = SequentialReader  # which reads compressed bags as well

_INSTEAD = {
    'Player': 'start `ros2 bag play` as a process',
    'PlayOptions': 'start `ros2 bag play` as a process',
    'Recorder': 'start `ros2 bag record` as a process, or write messages with SequentialWriter',
    'RecordOptions': 'start `ros2 bag record` as a process',
    'SequentialCompressionWriter': "use SequentialWriter with storage_preset_profile='zstd_fast'",
    'bag_rewrite': 'start `ros2 bag convert` as a process',
}


def __getattr__(name: str) -> NoReturn:
    if name in _INSTEAD:
        raise AttributeError(f"rosbag2_py has no '{name}' here: {_INSTEAD[name]}")
    raise AttributeError(f"module 'rosbag2_py' has no attribute '{name}'")

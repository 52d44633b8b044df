# SPDX-License-Identifier: Apache-2.0
"""Write one MCAP file in the layout of rosbag2, in chunks that reach the disk soon."""

from __future__ import annotations

from collections import Counter
from contextlib import suppress
import fcntl
import os
import sys
import time
from typing import Any, cast

from mcap.writer import CompressionType, Writer
from ros2bag.storage.definitions import Definition
from ros2bag.storage.metadata import (
    BagMetadata,
    FileInformation,
    MessageSpan,
    metadata_to_text,
    Topic,
    TopicInformation,
)
from ros2bag.storage.offered_qos import qos_to_text

__all__ = ['CHUNK_BYTES', 'McapFile', 'PatientFile', 'is_being_written']

COMPRESSIONS = {
    'none': CompressionType.NONE,
    'lz4': CompressionType.LZ4,
    'zstd': CompressionType.ZSTD,
}
# A killed process loses its current chunk: at most this duration or size.
CHUNK_TIME_S = 0.1
CHUNK_BYTES = 256 * 1024
RECORD_BYTES = 31
SEQUENCES = 2**32


class McapFile:
    """
    Writer of one MCAP file of a bag.

    After an OSError everything is kept in memory: `retry` and `finish` can be called when there is
    free space again.

    Parameters
    ----------
    path
        The file to create.
    name
        The file name for the metadata, if the file will be renamed afterwards.
    compression
        The compression of the chunks: `none`, `lz4` or `zstd`.
    ros_distro
        The name of the ROS distribution, for the metadata.
    chunk_bytes
        The chunk size at which it is written; `flush_if_due` writes it after 0.1 s.

    Raises
    ------
    OSError
        The file exists already or cannot be created.

    """

    def __init__(
        self,
        path: str,
        *,
        name: str = '',
        compression: str = 'none',
        ros_distro: str = '',
        chunk_bytes: int = CHUNK_BYTES,
    ) -> None:
        self._stream = PatientFile(path)
        self._name = name or os.path.basename(path)
        self._ros_distro = ros_distro
        self._chunk_bytes = chunk_bytes
        self._writer: Any = Writer(
            cast(Any, self._stream),
            chunk_size=sys.maxsize,
            compression=COMPRESSIONS[compression],
            enable_data_crcs=True,
        )
        self._writer.start(profile='ros2', library='ros2bag')
        self._is_finished = False
        self._waiting_bytes = 0
        self._waiting_since_s = float('inf')
        self._schema_ids: dict[str, int] = {}
        self._channel_ids: dict[str, int] = {}
        self._topics: dict[str, Topic] = {}
        self._counts: Counter[str] = Counter()
        self._message_count = 0
        self._start_ns, self._end_ns = MessageSpan().start_ns, MessageSpan().end_ns

    @property
    def size_bytes(self) -> int:
        """Return the size of the file, including pending data."""
        return self._stream.tell() + self._waiting_bytes

    @property
    def message_count(self) -> int:
        """Return the number of messages."""
        return self._message_count

    @property
    def start_ns(self) -> int:
        """Return the time of the first message."""
        return self._start_ns

    def add_topic(self, topic: Topic, definition: Definition) -> None:
        """
        Register a topic, before its first message, with its schema and channel.

        Parameters
        ----------
        topic
            The topic.
        definition
            The definition of its type; may be empty.

        """
        if topic.type_name not in self._schema_ids:
            self._schema_ids[topic.type_name] = self._writer.register_schema(
                topic.type_name, definition.encoding, definition.text.encode()
            )
        self._channel_ids[topic.name] = self._writer.register_channel(
            topic.name,
            topic.serialization_format,
            self._schema_ids[topic.type_name],
            {
                'offered_qos_profiles': qos_to_text(topic.offered_qos),
                'topic_type_hash': topic.type_hash,
            },
        )
        self._topics[topic.name] = topic

    def write(
        self, topic: str, data: bytes, log_ns: int, publish_ns: int, sequence: int = 0
    ) -> None:
        """
        Add a message of a topic that is registered.

        Parameters
        ----------
        topic
            The name of the topic.
        data
            The serialized message.
        log_ns, publish_ns
            The reception time of the recorder and the publication time, in ns since the epoch.
        sequence
            The publisher's sequence number, of which the lower 32 bits are stored.

        Raises
        ------
        OSError
            The chunk could not be written; it is kept for `retry`.

        """
        self._writer.add_message(
            self._channel_ids[topic], log_ns, data, publish_ns, sequence % SEQUENCES
        )
        self._counts[topic] += 1
        self._message_count += 1
        self._start_ns = min(self._start_ns, log_ns)
        self._end_ns = max(self._end_ns, log_ns)
        if not self._waiting_bytes:
            self._waiting_since_s = time.monotonic()
        self._waiting_bytes += len(data) + RECORD_BYTES
        if self._waiting_bytes >= self._chunk_bytes:
            self._flush()

    def flush_if_due(self) -> None:
        """Write the current chunk if it is old enough."""
        if time.monotonic() - self._waiting_since_s >= CHUNK_TIME_S:
            self._flush()

    def retry(self) -> None:
        """Write the data that could not be written before."""
        self._stream.retry()

    def finish(self) -> None:
        """Write pending data, the index and the metadata; a second call only checks for errors."""
        if not self._is_finished:
            self._is_finished = True
            self._write_end()
        self._stream.check()

    def close(self) -> None:
        """Close the file as it is."""
        self._stream.close()

    def metadata(self) -> BagMetadata:
        """Return the metadata of a recording that consists of this file."""
        span = MessageSpan(self.message_count, self._start_ns, self._end_ns)
        topics = tuple(
            TopicInformation(topic, self._counts[name]) for name, topic in self._topics.items()
        )
        return BagMetadata((FileInformation(self._name, span),), topics, self._ros_distro)

    def _write_end(self) -> None:
        # The checksum of the data must include the last chunk.
        self._writer.flush()
        self._writer.add_metadata(
            'rosbag2', {'serialized_metadata': metadata_to_text(self.metadata())}
        )
        self._writer.finish()

    def _flush(self) -> None:
        self._writer.flush()
        self._waiting_bytes = 0
        self._waiting_since_s = float('inf')
        self._stream.check()


class PatientFile:
    """
    New unbuffered file: written data persist, even if the process is killed.

    A write never fails and is never partial. Data that cannot be written are kept, `check` raises
    the reason, and `retry` writes them when there is space again. The file is locked while open.

    Parameters
    ----------
    path
        The file to create.

    Raises
    ------
    OSError
        The file exists already or cannot be created.

    """

    def __init__(self, path: str) -> None:
        self._file = open(path, 'xb', buffering=0)  # noqa: SIM115
        with suppress(OSError):
            # Some network file systems do not support locks.
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        self._rest = b''
        self._error: OSError | None = None

    def write(self, data: bytes) -> int:
        """
        Write all of the data, now or when there is space again.

        Parameters
        ----------
        data
            The bytes to append.

        Returns
        -------
        int
            The length of the data.

        """
        self._rest += data
        if self._error is None:
            self._write_rest()
        return len(data)

    def tell(self) -> int:
        """Return the file position, including pending data."""
        return self._file.tell() + len(self._rest)

    def flush(self) -> None:
        """Flush nothing, since the file is unbuffered."""

    def check(self) -> None:
        """Raise the error of a failed write that is still pending, if there is one."""
        if self._error is not None:
            raise self._error

    def retry(self) -> None:
        """Write the pending data; raise the error if that fails again."""
        self._error = None
        self._write_rest()
        self.check()

    def close(self) -> None:
        """Close the file, which also unlocks it."""
        self._file.close()

    def _write_rest(self) -> None:
        """Write until nothing is left: a disk that becomes full may accept a part first."""
        try:
            while self._rest:
                count = self._file.write(self._rest)
                self._rest = self._rest[count:]
        except OSError as error:
            self._error = error


def is_being_written(path: str) -> bool:
    """
    Whether a process has this file open as a `PatientFile`.

    Parameters
    ----------
    path
        The file, which exists.

    """
    with open(path, 'rb') as stream:
        try:
            fcntl.flock(stream, fcntl.LOCK_SH | fcntl.LOCK_NB)
        except BlockingIOError:
            return True
        except OSError:
            return False
    return False

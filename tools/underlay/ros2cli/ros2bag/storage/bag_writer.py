# SPDX-License-Identifier: Apache-2.0
"""Write a recording: a folder with files, split by size or time, and `metadata.yaml`."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
import errno
import os
from typing import NoReturn

from ros2bag.storage import BagError
from ros2bag.storage.definitions import Definition
from ros2bag.storage.latched import LatchedMessages, RecordedMessage
from ros2bag.storage.mcap_file import CHUNK_BYTES, McapFile
from ros2bag.storage.metadata import BagMetadata, FILE_NAME, merged, metadata_to_text, Topic

__all__ = ['RESERVE_NAME', 'BagWriter', 'Reserve', 'WriterOptions']

DEFAULT_DISTRO = 'jazzy'
RESERVE_NAME = '.reserve'
RESERVED_BYTES = 4 * 1024 * 1024


@dataclass(frozen=True)
class WriterOptions:
    """Options for writing a recording; zero means no limit."""

    compression: str = 'none'
    max_bytes: int = 0
    max_duration_ns: int = 0
    chunk_bytes: int = CHUNK_BYTES
    ros_distro: str = DEFAULT_DISTRO
    custom_data: Mapping[str, str] = field(default_factory=dict)


class BagWriter:
    """
    Writer of a bag: a folder of MCAP files, split by size or time, and `metadata.yaml`.

    When the disk is full, the bag is completed in reserved space, and BagError is raised.

    Parameters
    ----------
    folder
        The folder to create.
    options
        Compression, limits and custom data.
    find_definition
        Returns the definition of a message type such as `std_msgs/msg/String`.
    on_split
        Called with the paths of the file that is finished and of the following one.

    Raises
    ------
    BagError
        The folder exists already or cannot be written.

    """

    def __init__(
        self,
        folder: str,
        options: WriterOptions,
        find_definition: Callable[[str], Definition],
        on_split: Callable[[str, str], object] = lambda closed, opened: None,
    ) -> None:
        self._on_split = on_split
        self._folder = os.path.abspath(folder)
        self._options = options
        self._find_definition = find_definition
        self._topics: dict[str, Topic] = {}
        self._present: dict[str, Topic] = {}
        self._latched = LatchedMessages()
        self._finished: list[BagMetadata] = []
        self._is_open = True
        self._reserve = self._start(folder)
        self._file = self._create_file(0)

    @property
    def message_count(self) -> int:
        """Return the number of messages written to all files."""
        return self.metadata().span.message_count

    def set_topic(self, topic: Topic) -> None:
        """
        Register a topic, or update the QoS that its publishers offer now.

        The first description of a topic is recorded: readers expect it to be the same in all
        files and in `metadata.yaml`. Later publishers only affect which messages are latched.

        Parameters
        ----------
        topic
            The topic with its type and the QoS that its publishers offer.

        """
        if topic.name not in self._topics:
            self._topics[topic.name] = topic
            self._file.add_topic(topic, self._find_definition(topic.type_name))
        self._present[topic.name] = topic

    def write(self, message: RecordedMessage) -> None:
        """
        Write a message; start the next file first if this one is full.

        Parameters
        ----------
        message
            The message, of a topic that is registered.

        Raises
        ------
        BagError
            The disk is full or the file too large; the recording has ended.

        """
        try:
            if self._is_full(message.log_ns):
                self._split(message.log_ns)
            self._file.write(*message)
        except OSError as error:
            self._stop(error)
        topic = self._present[message.topic]
        if topic.is_latched:
            self._latched.add(message, topic)

    def split(self, now_ns: int) -> None:
        """
        Start the next file, unless this one is still empty.

        Parameters
        ----------
        now_ns
            The time at which latched messages are repeated in it, in ns since the epoch.

        Raises
        ------
        BagError
            The disk is full or the file too large; the recording has ended.

        """
        if self._file.message_count:
            try:
                self._split(now_ns)
            except OSError as error:
                self._stop(error)

    def flush_if_due(self) -> None:
        """Write the current chunk if it is old enough."""
        try:
            self._file.flush_if_due()
        except OSError as error:
            self._stop(error)

    def close(self) -> None:
        """Finish the last file and write `metadata.yaml`."""
        if self._is_open:
            self._reserve.release()
            try:
                self._finish()
            except OSError as error:
                self._stop(error)

    def metadata(self) -> BagMetadata:
        """Return the metadata of all files."""
        return replace(
            merged([*self._finished, self._file.metadata()]),
            custom_data=self._options.custom_data,
        )

    def _start(self, folder: str) -> Reserve:
        """Create the folder and reserve disk space in it."""
        try:
            os.makedirs(self._folder)
        except FileExistsError as error:
            raise BagError(
                f"Output folder '{folder}' already exists: name another one with -o, or delete it"
            ) from error
        except OSError as error:
            raise _not_writable(folder, error) from error
        try:
            return Reserve(self._folder)
        except OSError as error:
            os.rmdir(self._folder)
            raise _not_writable(folder, error) from error

    def _path(self, number: int) -> str:
        return os.path.join(self._folder, f'{os.path.basename(self._folder)}_{number}.mcap')

    def _create_file(self, number: int) -> McapFile:
        return McapFile(
            self._path(number),
            compression=self._options.compression,
            ros_distro=self._options.ros_distro,
            chunk_bytes=self._options.chunk_bytes,
        )

    def _is_full(self, now_ns: int) -> bool:
        options = self._options
        if not self._file.message_count:
            return False
        too_large = options.max_bytes and self._file.size_bytes >= options.max_bytes
        too_long = (
            options.max_duration_ns and now_ns - self._file.start_ns >= options.max_duration_ns
        )
        return bool(too_large or too_long)

    def _split(self, now_ns: int) -> None:
        """Start the next file with the topics and the latched messages."""
        self._file.finish()
        following = self._create_file(len(self._finished) + 1)
        self._file.close()
        self._finished.append(self._file.metadata())
        self._file = following
        for topic in self._topics.values():
            self._file.add_topic(topic, self._find_definition(topic.type_name))
        for message in self._latched.alive(now_ns):
            self._file.write(*message.logged_at(now_ns))
        number = len(self._finished)
        self._on_split(self._path(number - 1), self._path(number))

    def _write_metadata(self) -> None:
        path = os.path.join(self._folder, FILE_NAME)
        with open(path, 'w', encoding='utf-8') as stream:
            stream.write(metadata_to_text(self.metadata()))

    def _finish(self) -> None:
        self._file.retry()
        self._file.finish()
        self._file.close()
        self._write_metadata()
        self._is_open = False

    def _stop(self, error: OSError) -> NoReturn:
        """Finish the recording in the reserved disk space."""
        self._reserve.release()
        try:
            self._finish()
            outcome = f'its {self.message_count} messages are complete.'
        except OSError:
            self._is_open = False
            self._file.close()
            outcome = f'its index could not be written: {_advice(error, self._folder)}'
        raise BagError(
            f"'{self._folder}' cannot be written: {error.strerror}. "
            f'The recording ends here; {outcome}'
        ) from error


def _advice(error: OSError, folder: str) -> str:
    if error.errno == errno.EFBIG:
        return f'run ros2 bag recover {folder}, and next time split the recording with -b BYTES'
    return f'free some space, then run ros2 bag recover {folder}'


def _not_writable(folder: str, error: OSError) -> BagError:
    return BagError(f"Output folder '{folder}' cannot be written: {error.strerror}")


class Reserve:
    """
    Reserved disk space, to be released when the disk is full or the recording ends.

    Parameters
    ----------
    folder
        Where to create the file that takes the space (4 MiB).

    Raises
    ------
    OSError
        The disk does not have enough space left.

    """

    def __init__(self, folder: str) -> None:
        self._path = os.path.join(folder, RESERVE_NAME)
        try:
            with open(self._path, 'xb') as stream:
                os.posix_fallocate(stream.fileno(), 0, RESERVED_BYTES)
        except OSError as error:
            self.release()
            # Other errors are file size limits, or file systems without support for preallocation.
            if error.errno == errno.ENOSPC:
                raise

    def release(self) -> None:
        """Release the disk space; may be called more than once."""
        if os.path.exists(self._path):
            os.unlink(self._path)

# SPDX-License-Identifier: Apache-2.0
"""Read a recording: its messages in the order of log time, and the definitions of their types."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager
import os

from ros2bag.storage import BagError
from ros2bag.storage.definitions import Definition
from ros2bag.storage.description import database_of, describe_file, read_metadata
from ros2bag.storage.latched import RecordedMessage
from ros2bag.storage.metadata import BagMetadata

__all__ = ['READABLE', 'BagReader']

READABLE = ('mcap', 'sqlite3')
"""The formats of files that are read, by their identifiers in `metadata.yaml`."""
WHOLE_FILES, EACH_MESSAGE = 'file', 'message'
"""The modes in which recorders compress, besides the chunks of MCAP files."""


class BagReader:
    """
    Reader of a bag, in MCAP or SQLite: its folder, or a single file.

    Parameters
    ----------
    path
        The folder with `metadata.yaml`, or the file; also an attribute.

    Attributes
    ----------
    metadata
        The metadata from `metadata.yaml`, or from the index of the file.

    Raises
    ------
    BagError
        The path does not exist, or its metadata are missing or malformed.

    """

    def __init__(self, path: str) -> None:
        if not path:
            raise BagError('The path of the bag is empty: name its folder')
        self.path = path
        if os.path.isdir(path):
            self._folder = path
            self.metadata = read_metadata(path)
        elif os.path.exists(path):
            self._folder = os.path.dirname(path)
            self.metadata = describe_file(path)
        else:
            raise BagError(_missing_text(path))

    @property
    def size_bytes(self) -> int:
        """Return the total size of the existing files."""
        return sum(os.path.getsize(path) for path in self._paths() if os.path.exists(path))

    @property
    def missing_paths(self) -> list[str]:
        """Return the files that do not exist."""
        return [path for path in self._paths() if not os.path.exists(path)]

    def check(self) -> None:
        """Raise BagError unless messages can be read from all files."""
        if not _is_readable(self.metadata):
            raise BagError(_foreign_text(self.path, self.metadata))
        for path in self._paths():
            if self.metadata.compression_mode == WHOLE_FILES:
                from ros2bag.storage.compressed import check_magic
                from ros2bag.storage.damage import damage_told

                with damage_told(path):
                    check_magic(path)
            elif (database := database_of(path)) is not None:
                database.check()
            else:
                describe_file(path)

    def messages(
        self,
        topics: Collection[str] | None = None,
        start_ns: int = 0,
        on_split: Callable[[str, str], None] = lambda *_: None,
    ) -> Iterator[RecordedMessage]:
        """
        Read the messages file by file, within a file in the order of their log times.

        Parameters
        ----------
        topics
            The names of the topics to read; None for all.
        start_ns
            The earliest log time, in ns since the epoch.
        on_split
            Called before the first message of another file with the path of the file that was
            read and that of the one that messages come from now.

        Yields
        ------
        RecordedMessage
            Serialized messages with their times.

        Raises
        ------
        BagError
            A file is missing or unreadable; BrokenFile if it is truncated or damaged.

        """
        read = ''
        for path in self._paths():
            with self._plain(path) as plain:
                messages = _messages_of(plain, topics, start_ns)
                if self.metadata.compression_mode == EACH_MESSAGE:
                    from ros2bag.storage.compressed import with_plain_data

                    messages = with_plain_data(messages)
                for message in messages:
                    if read not in ('', path):
                        on_split(read, path)
                    read = path
                    yield message

    def definitions(self) -> dict[str, Definition]:
        """
        Return the definitions of the types, as they were recorded, by their names.

        Raises
        ------
        BagError
            A file is missing or unreadable; BrokenFile if it is truncated or damaged.

        """
        found: dict[str, Definition] = {}
        for path in self._paths():
            with self._plain(path) as plain:
                found.update(_definitions_of(plain))
        return found

    def _paths(self) -> list[str]:
        return [os.path.join(self._folder, file.path) for file in self.metadata.files]

    @contextmanager
    def _plain(self, path: str) -> Iterator[str]:
        """Give a file that is not compressed as a whole, for the length of a `with` block."""
        if self.metadata.compression_mode != WHOLE_FILES:
            yield path
            return
        from ros2bag.storage.compressed import decompressed
        from ros2bag.storage.damage import damage_told

        with damage_told(path), decompressed(path) as plain:
            yield plain


def _messages_of(
    path: str, topics: Collection[str] | None, start_ns: int
) -> Iterator[RecordedMessage]:
    """Read the messages of a file."""
    if (database := database_of(path)) is not None:
        yield from database.messages(topics, start_ns)
        return
    from mcap.reader import SeekingReader
    from ros2bag.storage.damage import BoundedFile, damage_told, limit_chunks

    limit_chunks()
    with damage_told(path), BoundedFile(path) as stream:
        reader = SeekingReader(stream, validate_crcs=True)
        for _, channel, message in reader.iter_messages(topics, starting_at=start_ns):
            yield RecordedMessage(
                channel.topic,
                message.data,
                message.log_time,
                message.publish_time,
                message.sequence,
            )


def _definitions_of(path: str) -> dict[str, Definition]:
    """Return the definitions in a file."""
    if (database := database_of(path)) is not None:
        return database.definitions()
    from mcap.reader import SeekingReader
    from ros2bag.storage.damage import BoundedFile, damage_told

    with damage_told(path), BoundedFile(path) as stream:
        summary = SeekingReader(stream).get_summary()
        schemas = summary.schemas.values() if summary else ()
        return {each.name: Definition(each.encoding, each.data.decode()) for each in schemas}


def _is_readable(metadata: BagMetadata) -> bool:
    """Check whether the files of a bag and their compression are known here."""
    is_plain = metadata.compression_mode in ('', 'none')
    is_known = metadata.compression_mode in (WHOLE_FILES, EACH_MESSAGE)
    is_decompressed = is_known and metadata.compression_format == 'zstd'
    return metadata.storage_identifier in READABLE and (is_plain or is_decompressed)


def _missing_text(path: str) -> str:
    from ros_environment.suggestions import did_you_mean

    folder, name = os.path.split(os.path.abspath(path))
    known = os.listdir(folder) if os.path.isdir(folder) else []
    return f"Bag path '{path}' does not exist! {did_you_mean(name, known)}".rstrip()


def _foreign_text(path: str, metadata: BagMetadata) -> str:
    what = (
        f'compressed ({metadata.compression_format}, by {metadata.compression_mode})'
        if metadata.storage_identifier in READABLE
        else f"in the format '{metadata.storage_identifier}'"
    )
    return (
        f"'{path}' is {what}, but only MCAP and SQLite are read here, plain or compressed with "
        'zstd. Convert it first: '
        f'rosbags-convert --src {path} --dst {path.rstrip("/")}_mcap '
        '--dst-storage mcap'
    )

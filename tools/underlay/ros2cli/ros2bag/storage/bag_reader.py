# SPDX-License-Identifier: Apache-2.0
"""Read a recording: its metadata, and its messages in the order of log time."""

from __future__ import annotations

from collections.abc import Collection, Iterator
import os

from ros2bag.storage.errors import BagError
from ros2bag.storage.latched import RecordedMessage
from ros2bag.storage.metadata import BagMetadata
from ros2bag.storage.metadata_yaml import FILE_NAME, metadata_from_text

__all__ = ['BagReader']


class BagReader:
    """
    Reader of a bag: its folder, or a single MCAP file.

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
            from ros2bag.storage.mcap_summary import describe_file

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
        metadata = self.metadata
        if metadata.storage_identifier != 'mcap' or metadata.compression_mode not in ('', 'none'):
            raise BagError(_foreign_text(self.path, metadata))
        from ros2bag.storage.mcap_summary import describe_file

        for path in self._paths():
            describe_file(path)

    def messages(
        self, topics: Collection[str] | None = None, start_ns: int = 0
    ) -> Iterator[RecordedMessage]:
        """
        Read the messages file by file, within a file in the order of their log times.

        Parameters
        ----------
        topics
            The names of the topics to read; None for all.
        start_ns
            The earliest log time, in ns since the epoch.

        Yields
        ------
        RecordedMessage
            Serialized messages with their times.

        Raises
        ------
        BagError
            A file is missing or unreadable; BrokenFile if it is truncated or damaged.

        """
        from mcap.reader import SeekingReader
        from ros2bag.storage.bounded_chunks import limit_chunks
        from ros2bag.storage.damage import BoundedFile, damage_told

        limit_chunks()
        for path in self._paths():
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

    def _paths(self) -> list[str]:
        return [os.path.join(self._folder, file.path) for file in self.metadata.files]


def read_metadata(folder: str) -> BagMetadata:
    """
    Read `metadata.yaml` of a recording.

    Parameters
    ----------
    folder
        The folder of the recording.

    Raises
    ------
    BagError
        It does not exist, cannot be read, or is malformed.

    """
    path = os.path.join(folder, FILE_NAME)
    try:
        with open(path, encoding='utf-8') as stream:
            return metadata_from_text(stream.read(), path)
    except FileNotFoundError as error:
        raise BagError(_no_metadata_text(folder)) from error
    except (OSError, UnicodeDecodeError) as error:
        raise BagError(f"'{path}' cannot be read: {error}") from error


def _no_metadata_text(folder: str) -> str:
    if any(name.endswith('.mcap') for name in os.listdir(folder)):
        return (
            f"'{folder}' has no {FILE_NAME}: its recording is still running or was not finished. "
            f'What it has can be saved: ros2 bag recover {folder}'
        )
    return f"'{folder}' is not the folder of a recording: it has no {FILE_NAME}"


def _missing_text(path: str) -> str:
    from ros2cli.suggest import did_you_mean

    folder, name = os.path.split(os.path.abspath(path))
    known = os.listdir(folder) if os.path.isdir(folder) else []
    return f"Bag path '{path}' does not exist! {did_you_mean(name, known)}".rstrip()


def _foreign_text(path: str, metadata: BagMetadata) -> str:
    what = (
        f'compressed ({metadata.compression_format}, by {metadata.compression_mode})'
        if metadata.storage_identifier == 'mcap'
        else f"in the format '{metadata.storage_identifier}'"
    )
    return (
        f"'{path}' is {what}, and only plain MCAP is read here. Convert it first: "
        f'rosbags-convert --src {path} --dst {path.rstrip("/")}_mcap '
        '--dst-storage mcap'
    )

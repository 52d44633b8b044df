# SPDX-License-Identifier: Apache-2.0
"""Read files of recordings in SQLite, which ROS 2 wrote by default before Iron."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from contextlib import closing, contextmanager
import os
import sqlite3
from urllib.request import pathname2url

from ros2bag.storage import BagError
from ros2bag.storage.damage import BrokenFile
from ros2bag.storage.definitions import Definition
from ros2bag.storage.latched import RecordedMessage
from ros2bag.storage.metadata import (
    BagMetadata,
    FileInformation,
    MessageSpan,
    Topic,
    TopicInformation,
)
from ros2bag.storage.offered_qos import qos_from_text

__all__ = ['SUFFIX', 'SqliteFile', 'is_sqlite']

SUFFIX = '.db3'
IDENTIFIER = 'sqlite3'
MAGIC = b'SQLite format 3\0'
TABLES = {'topics', 'messages'}


def is_sqlite(path: str) -> bool:
    """
    Check whether a file is a SQLite database, or is named as one.

    Parameters
    ----------
    path
        The file; it need not exist.

    """
    if path.endswith(SUFFIX):
        return True
    try:
        with open(path, 'rb') as stream:
            return stream.read(len(MAGIC)) == MAGIC
    except OSError:
        return False


class SqliteFile:
    """
    A file of a recording in SQLite, in any of the four versions of its tables.

    Parameters
    ----------
    path
        The file.

    """

    def __init__(self, path: str) -> None:
        self._path = path

    def describe(self) -> BagMetadata:
        """
        Read the topics, and count the messages.

        Returns
        -------
        BagMetadata
            The metadata of a bag that consists of this file.

        Raises
        ------
        BagError
            The file is missing, unreadable or not a recording.
        BrokenFile
            The file is damaged.

        """
        with self._opened() as database:
            counts: dict[int, int] = {}
            span = MessageSpan()
            for topic, count, first_ns, last_ns in database.execute(
                'SELECT topic_id, COUNT(*), MIN(timestamp), MAX(timestamp) FROM messages '
                'GROUP BY topic_id'
            ):
                counts[topic] = count
                span = span.joined(MessageSpan(count, first_ns, last_ns))
            topics = [
                TopicInformation(topic, counts.get(number, 0))
                for number, topic in self._topics(database)
            ]
            distro = ''
            if 'ros_distro' in _columns(database, 'schema'):
                distro = (database.execute('SELECT ros_distro FROM schema').fetchone() or [''])[0]
        return BagMetadata(
            files=(FileInformation(os.path.basename(self._path), span),),
            topics=tuple(sorted(topics, key=lambda each: each.topic.name)),
            ros_distro=distro or '',
            storage_identifier=IDENTIFIER,
        )

    def check(self) -> None:
        """Raise BagError unless the file is there and has the tables of a recording."""
        with self._opened():
            pass

    def messages(
        self, topics: Collection[str] | None = None, start_ns: int = 0
    ) -> Iterator[RecordedMessage]:
        """
        Read the messages in the order of their log times, which are their only times.

        Parameters
        ----------
        topics, start_ns
            As for `BagReader.messages`.

        Yields
        ------
        RecordedMessage
            Serialized messages.

        Raises
        ------
        BagError
            As for `describe`.

        """
        with self._opened() as database:
            names = {number: topic.name for number, topic in self._topics(database)}
            wanted = {n: name for n, name in names.items() if topics is None or name in topics}
            rows = database.execute(
                'SELECT topic_id, timestamp, data FROM messages WHERE timestamp >= ? '
                'ORDER BY timestamp, id',
                (start_ns,),
            )
            for number, time_ns, data in rows:
                if number in wanted:
                    yield RecordedMessage(wanted[number], bytes(data), time_ns, time_ns)

    def definitions(self) -> dict[str, Definition]:
        """
        Return the definitions of the types by their names; files before Iron have none.

        Raises
        ------
        BagError
            As for `describe`.

        """
        with self._opened() as database:
            if not _columns(database, 'message_definitions'):
                return {}
            rows = database.execute(
                'SELECT topic_type, encoding, encoded_message_definition FROM message_definitions'
            )
            return {name: Definition(encoding, text) for name, encoding, text in rows}

    def _topics(self, database: sqlite3.Connection) -> list[tuple[int, Topic]]:
        """Return the topics with their numbers; older files lack QoS and type hashes."""
        cursor = database.execute('SELECT * FROM topics')
        names = [column[0] for column in cursor.description]
        found = []
        for row in cursor:
            values = dict(zip(names, row))
            topic = Topic(
                values['name'],
                values['type'],
                values.get('type_description_hash') or '',
                qos_from_text(values.get('offered_qos_profiles') or ''),
                values['serialization_format'],
            )
            found.append((values['id'], topic))
        return found

    @contextmanager
    def _opened(self) -> Iterator[sqlite3.Connection]:
        """Open the file for reading; translate errors to BagError."""
        path = self._path
        if not os.path.exists(path):
            raise BagError(
                f"the file '{path}' of the recording is missing. To continue without it: "
                f'ros2 bag reindex {os.path.dirname(path)}'
            )
        try:
            address = f'file:{pathname2url(os.path.abspath(path))}?mode=ro'
            with closing(sqlite3.connect(address, uri=True)) as database:
                if not all(_columns(database, table) for table in TABLES):
                    raise BagError(f"'{path}' is a database, but not one of a recording")
                yield database
        except sqlite3.OperationalError as error:
            raise BagError(f"'{path}' cannot be read: {error}") from error
        except (sqlite3.DatabaseError, KeyError, TypeError, ValueError) as error:
            raise BrokenFile(
                f"'{path}' is damaged ({error}). The program sqlite3 may save what is left: "
                f"sqlite3 {path} '.recover' | sqlite3 NEW{SUFFIX}"
            ) from error


def _columns(database: sqlite3.Connection, table: str) -> set[str]:
    """Return the names of the columns of a table; none if there is no such table."""
    return {row[1] for row in database.execute(f'PRAGMA table_info({table})')}

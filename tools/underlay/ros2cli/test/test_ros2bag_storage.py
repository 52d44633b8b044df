# SPDX-License-Identifier: Apache-2.0
"""Tests of recordings on disk, read back by us, by `rosbags` and by `mcap`."""

from pathlib import Path

from bag_samples import (
    find_definition,
    JOINTS,
    joints,
    LATCHED,
    MS,
    start_bag,
    START_NS,
    string,
    texts,
    topic,
    write_bag,
)
from mcap.reader import make_reader
import pytest
from ros2bag.storage import BagError
from ros2bag.storage.bag_reader import BagReader
from ros2bag.storage.latched import RecordedMessage
from ros2bag.storage.metadata import metadata_from_text
from ros2bag.storage.offered_qos import OfferedQos
from rosbags.highlevel import AnyReader
import yaml


def _write_two_topics(folder: Path, compression: str = 'none') -> list[RecordedMessage]:
    messages = [string('/description', '<robot/>', 0)]
    for number in range(50):
        messages.append(joints('/joints', [number, -0.5], (2 * number + 1) * MS))
        messages.append(string('/ticks', f'tick {number}', (2 * number + 2) * MS))
    writer = start_bag(
        folder,
        topic('/description', qos=LATCHED),
        topic('/joints', JOINTS),
        topic('/ticks'),
        compression=compression,
    )
    for message in messages:
        writer.write(message)
    writer.close()
    return messages


@pytest.mark.parametrize('compression', ['none', 'lz4', 'zstd'])
def test_rosbags_reads_message_for_message(tmp_path: Path, compression: str) -> None:
    """The second reader finds the same bytes; it checks definitions by the types' hashes."""
    messages = _write_two_topics(tmp_path / 'bag', compression)
    with AnyReader([tmp_path / 'bag']) as reader:
        found = [(c.topic, bytes(raw), at) for c, at, raw in reader.messages()]
        connection = next(c for c in reader.connections if c.topic == '/joints')
        first = next(raw for c, _, raw in reader.messages([connection]))
        assert reader.deserialize(first, JOINTS).position.tolist() == [0.0, -0.5]
        offered = {c.topic: c.ext.offered_qos_profiles[0] for c in reader.connections}
    assert found == [(each.topic, each.data, each.log_ns) for each in messages]
    assert offered['/description'].durability.name == 'TRANSIENT_LOCAL'
    assert offered['/ticks'].durability.name == 'VOLATILE'


def test_mcap_reads_message_for_message(tmp_path: Path) -> None:
    """The file stands on its own: profile, definitions, both times, index."""
    messages = _write_two_topics(tmp_path / 'bag')
    with (tmp_path / 'bag' / 'bag_0.mcap').open('rb') as stream:
        reader = make_reader(stream, validate_crcs=True)
        found = [
            (channel.topic, m.data, m.log_time, m.publish_time)
            for _, channel, m in reader.iter_messages()
        ]
        assert reader.get_header().profile == 'ros2'
        summary = reader.get_summary()
    assert found == [(m.topic, m.data, m.log_ns, m.publish_ns) for m in messages]
    assert summary.statistics.message_count == len(messages)
    assert {schema.encoding for schema in summary.schemas.values()} == {'ros2msg'}


def test_our_reader_chooses_topics_and_start(tmp_path: Path) -> None:
    """The topics and the start limit what is read."""
    write_bag(tmp_path / 'bag')
    reader = BagReader(str(tmp_path / 'bag'))
    reader.check()
    found = texts(reader.messages(['/ticks'], START_NS + 150 * MS), '/ticks')
    assert found == ['15', '16', '17', '18', '19']
    assert texts(reader.messages(['/description']), '/ticks') == []


def test_metadata_is_version_9(tmp_path: Path) -> None:
    """The metadata has what rosbag2 reads."""
    write_bag(tmp_path / 'bag', custom_data={'place': 'lab'})
    text = (tmp_path / 'bag' / 'metadata.yaml').read_text()
    content = yaml.safe_load(text)['rosbag2_bagfile_information']
    assert (content['version'], content['storage_identifier']) == (9, 'mcap')
    assert content['duration'] == {'nanoseconds': 190 * MS}
    assert content['starting_time'] == {'nanoseconds_since_epoch': START_NS}
    assert content['message_count'] == 21
    assert content['relative_file_paths'] == ['bag_0.mcap']
    assert content['files'][0]['message_count'] == 21
    assert content['custom_data'] == {'place': 'lab'}
    assert content['ros_distro'] == 'jazzy'
    first = content['topics_with_message_count'][0]['topic_metadata']
    assert (first['name'], first['type']) == ('/description', 'std_msgs/msg/String')
    assert first['offered_qos_profiles'][0]['durability'] == 'transient_local'
    assert first['type_description_hash'].startswith('RIHS01_df668c')
    assert '&id' not in text


def test_metadata_of_older_versions_is_read() -> None:
    """Quality of service as a text with numbers, and no list of files."""
    qos = yaml.safe_dump([{**OfferedQos().to_dict(), 'durability': 1, 'reliability': 2}])
    content = {
        'version': 4,
        'storage_identifier': 'mcap',
        'duration': {'nanoseconds': 5},
        'starting_time': {'nanoseconds_since_epoch': 10},
        'message_count': 2,
        'topics_with_message_count': [
            {
                'topic_metadata': {
                    'name': '/a',
                    'type': 'std_msgs/msg/String',
                    'serialization_format': 'cdr',
                    'offered_qos_profiles': qos,
                },
                'message_count': 2,
            }
        ],
        'relative_file_paths': ['a_0.mcap'],
    }
    metadata = metadata_from_text(yaml.safe_dump({'rosbag2_bagfile_information': content}), 'x')
    assert (metadata.span.message_count, metadata.span.end_ns) == (2, 15)
    offered = metadata.topics[0].topic.offered_qos[0]
    assert (offered.durability, offered.reliability) == ('transient_local', 'best_effort')


@pytest.mark.parametrize('text', ['', '- 1', 'rosbag2_bagfile_information: {version: 9}', '{'])
def test_broken_metadata_is_a_sentence(text: str) -> None:
    """What is no metadata leads to the command that makes it anew."""
    with pytest.raises(BagError, match="'x' is not metadata of a recording .*ros2 bag recover"):
        metadata_from_text(text, 'x')


@pytest.mark.parametrize(
    ('old', 'new', 'reason'),
    [
        ('message_count: 2', 'message_count: <b>', "'<b>' is not an integer"),
        ('nanoseconds: 5', "nanoseconds: '5'", "'5' is not an integer"),
        ('name: /a', 'name: [1]', r'\[1\] is not a string'),
        ('- a_0.mcap', '- 3', '3 is not a string'),
    ],
)
def test_metadata_with_values_of_other_kinds(old: str, new: str, reason: str) -> None:
    """Numbers are numbers and names are texts, whoever has written the file."""
    text = (
        'rosbag2_bagfile_information:\n  version: 4\n  storage_identifier: mcap\n'
        '  duration: {nanoseconds: 5}\n  starting_time: {nanoseconds_since_epoch: 10}\n'
        '  message_count: 2\n  topics_with_message_count:\n  - topic_metadata:\n'
        '      name: /a\n      type: std_msgs/msg/String\n      serialization_format: cdr\n'
        '    message_count: 2\n  relative_file_paths:\n  - a_0.mcap\n'
    )
    assert metadata_from_text(text, 'x').span.message_count == 2
    for part in range(1, text.count(old) + 1):
        pieces = text.split(old)
        broken = old.join(pieces[:part]) + new + old.join(pieces[part:])
        with pytest.raises(BagError, match=f'not metadata of a recording .*{reason}'):
            metadata_from_text(broken, 'x')


def test_split_by_duration_repeats_latched_messages(tmp_path: Path) -> None:
    """Each file can be played alone: the latched message is at its head."""
    write_bag(tmp_path / 'bag', count=20, period_ns=10 * MS, max_duration_ns=50 * MS)
    reader = BagReader(str(tmp_path / 'bag'))
    files = [file.path for file in reader.metadata.files]
    assert files == ['bag_0.mcap', 'bag_1.mcap', 'bag_2.mcap', 'bag_3.mcap']
    for number, name in enumerate(files):
        part = list(BagReader(str(tmp_path / 'bag' / name)).messages())
        assert part[0].topic == '/description'
        assert part[0].log_ns == START_NS + number * 50 * MS
        assert texts(part, '/ticks') == [str(5 * number + each) for each in range(5)]
    with AnyReader([tmp_path / 'bag']) as other:
        assert other.message_count == 24 == reader.metadata.span.message_count


def test_split_by_size(tmp_path: Path) -> None:
    """No file becomes much larger than the limit, and nothing is lost."""
    writer = start_bag(tmp_path / 'bag', topic('/ticks'), max_bytes=100_000)
    for number in range(50):
        writer.write(string('/ticks', f'{number} {"x" * 10_000}', number * MS))
    writer.close()
    reader = BagReader(str(tmp_path / 'bag'))
    assert len(reader.metadata.files) > 4
    assert all(path.stat().st_size < 125_000 for path in (tmp_path / 'bag').glob('*.mcap'))
    numbers = [text.split()[0] for text in texts(reader.messages(), '/ticks')]
    assert numbers == [str(number) for number in range(50)]


def test_what_a_late_subscriber_would_not_get_is_not_repeated(tmp_path: Path) -> None:
    """A latched message is not repeated when its lifespan is over, as those of /rosout."""
    short_lived = OfferedQos(durability='transient_local', lifespan_ns=20 * MS)
    topics = topic('/ticks'), topic('/log', qos=short_lived)
    writer = start_bag(tmp_path / 'bag', *topics, max_duration_ns=30 * MS)
    writer.write(string('/log', 'old', 0))
    writer.write(string('/log', 'new', 25 * MS))
    writer.write(string('/ticks', '0', 30 * MS))
    writer.close()
    second = BagReader(str(tmp_path / 'bag' / 'bag_1.mcap'))
    assert texts(second.messages(), '/log') == ['new']


def test_all_latched_messages_of_several_publishers_are_repeated(tmp_path: Path) -> None:
    """Of small messages, such as those of /tf_static, older ones are repeated as well."""
    writer = start_bag(tmp_path / 'bag', topic('/static', qos=LATCHED), max_duration_ns=30 * MS)
    for number in range(4):
        writer.write(string('/static', str(number), number * MS))
    writer.write(string('/static', '4', 40 * MS))
    writer.close()
    second = BagReader(str(tmp_path / 'bag' / 'bag_1.mcap'))
    assert texts(second.messages(), '/static') == ['0', '1', '2', '3', '4']


def test_publishers_that_come_later_change_nothing_in_the_files(tmp_path: Path) -> None:
    """A reader that compares the files with the metadata finds all messages."""
    writer = start_bag(tmp_path / 'bag', topic('/ticks'), max_duration_ns=30 * MS)
    for number in range(20):
        writer.write(string('/ticks', str(number), number * 10 * MS))
        if number == 7:
            writer.set_topic(topic('/ticks', qos=LATCHED))
    writer.close()
    with AnyReader([tmp_path / 'bag']) as reader:
        assert len(list(reader.messages())) == reader.message_count > 20


def test_existing_folder_is_refused(tmp_path: Path) -> None:
    """Nothing is ever overwritten."""
    with pytest.raises(BagError, match='already exists: name another one'):
        start_bag(tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_empty_recording_is_valid(tmp_path: Path) -> None:
    """A recording without messages is readable."""
    start_bag(tmp_path / 'bag', topic('/ticks')).close()
    reader = BagReader(str(tmp_path / 'bag'))
    reader.check()
    assert list(reader.messages()) == []
    with AnyReader([tmp_path / 'bag']) as other:
        assert other.message_count == 0


def test_definition_of_unknown_type_is_empty(tmp_path: Path) -> None:
    """Messages are recorded also if nobody knows how they are defined."""
    assert find_definition('nope_msgs/msg/Nope') == ('', '')
    assert find_definition('std_msgs/srv/Nope') == ('', '')
    writer = start_bag(tmp_path / 'bag', topic('/ticks'))
    writer.close()


@pytest.mark.parametrize(
    ('change', 'error'),
    [
        (
            ('storage_identifier: mcap', 'storage_identifier: other'),
            "'other'.*rosbags-convert",
        ),
        (
            ("compression_mode: ''", 'compression_mode: FILE\n  compression_format: lz4'),
            'compressed.*rosbags-convert',
        ),
        (('version: 9', 'version: 10'), 'has version 10'),
    ],
)
def test_foreign_recordings_are_a_sentence(
    tmp_path: Path, change: tuple[str, str], error: str
) -> None:
    """A recording of another kind leads to the program that converts it."""
    write_bag(tmp_path / 'bag')
    path = tmp_path / 'bag' / 'metadata.yaml'
    path.write_text(path.read_text().replace(*change))
    with pytest.raises(BagError, match=error):
        BagReader(str(tmp_path / 'bag')).check()

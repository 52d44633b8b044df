# SPDX-License-Identifier: Apache-2.0
"""Tests of `ros2 bag info` and `list`, and of the choice of topics."""

from collections.abc import Callable
from pathlib import Path
import re
from subprocess import CompletedProcess

from bag_samples import write_bag
import pytest
from ros2bag.api.common_arguments import TopicFilter
from ros2bag.storage.bag_reader import BagReader
from ros2bag.verb.info import human_size

Ros2 = Callable[..., CompletedProcess[str]]


def test_info(tmp_path: Path, ros2_here: Ros2) -> None:
    """The account of a recording has the titles and columns of rosbag2."""
    write_bag(tmp_path / 'bag', max_duration_ns=100_000_000, custom_data={'place': 'lab'})
    result = ros2_here('bag', 'info', str(tmp_path / 'bag'))
    assert (result.returncode, result.stderr) == (0, '')
    lines = result.stdout.splitlines()
    assert lines[:2] == ['Files:             bag_0.mcap', '                   bag_1.mcap']
    assert re.fullmatch(r'Bag size:          \d+\.\d KiB', lines[2])
    assert lines[3:6] == [
        'Storage id:        mcap',
        'ROS Distro:        jazzy',
        'Duration:          0.19s',
    ]
    assert re.fullmatch(
        r'Start:             Nov 1\d 2023 \d\d:\d\d:20\.000000000 \(1700000000\.000000000\)',
        lines[6],
    )
    assert lines[8:] == [
        'Messages:          22',
        'Custom data:       place: lab',
        'Topic information: Topic: /description | Type: std_msgs/msg/String | Count: 2 | '
        'Serialization Format: cdr',
        '                   Topic: /ticks | Type: std_msgs/msg/String | Count: 20 | '
        'Serialization Format: cdr',
        'Service:           0',
    ]


def test_info_of_names_and_details(tmp_path: Path, ros2_here: Ros2) -> None:
    """The names alone can be printed, or rates, hashes and quality of service as well."""
    write_bag(tmp_path / 'bag')
    path = str(tmp_path / 'bag')
    assert ros2_here('bag', 'info', '-t', path).stdout == '/description\n/ticks\n'
    output = ros2_here('bag', 'info', '-v', path).stdout
    assert 'Offered QoS: reliable, transient_local, unknown (depth 0)' in output
    assert 'Type hash: RIHS01_df668c' in output
    assert 'Average rate: 105 Hz' in output


def test_info_of_a_single_file(tmp_path: Path, ros2_here: Ros2) -> None:
    """A file knows as much as the folder."""
    write_bag(tmp_path / 'bag')
    folder = ros2_here('bag', 'info', str(tmp_path / 'bag')).stdout
    assert ros2_here('bag', 'info', str(tmp_path / 'bag' / 'bag_0.mcap')).stdout == folder


def test_missing_bags_are_sentences(tmp_path: Path, ros2_here: Ros2) -> None:
    """A path that does not exist, or is something else, is an error of one line."""
    write_bag(tmp_path / 'morning_walk')
    result = ros2_here('bag', 'info', str(tmp_path / 'mornin_walk'))
    assert (result.returncode, result.stdout) == (1, '')
    assert result.stderr == (
        f"Bag path '{tmp_path}/mornin_walk' does not exist! Did you mean 'morning_walk'?\n"
    )
    result = ros2_here('bag', 'play', str(tmp_path))
    expected = f"'{tmp_path}' is not the folder of a recording: it has no metadata.yaml\n"
    assert (result.returncode, result.stderr) == (1, expected)


def test_missing_file_of_a_bag_is_named(tmp_path: Path, ros2_here: Ros2) -> None:
    """A recording of which a file was deleted is refused before anything is played."""
    write_bag(tmp_path / 'bag')
    (tmp_path / 'bag' / 'bag_0.mcap').unlink()
    text = f"the file '{tmp_path}/bag/bag_0.mcap' of the recording is missing"
    with pytest.raises(RuntimeError, match=f'{text}. .* ros2 bag reindex {tmp_path}/bag'):
        BagReader(str(tmp_path / 'bag')).check()
    result = ros2_here('bag', 'info', str(tmp_path / 'bag'))
    assert (result.returncode, result.stderr) == (0, f'WARNING: {text}\n')


def test_list(ros2_here: Ros2) -> None:
    """The formats are listed."""
    assert ros2_here('bag', 'list', 'storage').stdout == 'mcap\nsqlite3\n'
    assert ros2_here('bag', 'list', 'compressor').stdout == 'lz4\nzstd\n'


@pytest.mark.parametrize(
    ('words', 'status', 'error'),
    [
        (['record'], 1, 'Nothing to record: name topics after --topics'),
        (['record', '-a', '--topics', '/a'], 1, 'but not both'),
        (['record', '-a', '--compression-mode', 'file'], 1, 'Choose the compression as well'),
        (['record', '--topics', '/a b'], 1, "'/a b' is not a valid topic name"),
        (['record', '-e', '('], 2, "'(' is not a regular expression"),
        (['record', '-a', '-b', '-1'], 2, 'is not a non-negative integer'),
        (['record', '-a', '--custom-data', 'x'], 2, "'x' is not of the form KEY=VALUE"),
        (['record', '-a', '-o', ''], 1, 'The name of the output folder is empty'),
        (['record', '--all-actions'], 2, 'actions cannot be recorded in ROS 2 Jazzy'),
        (['record', '-a', '--services', '/a'], 1, 'or all services, but not both'),
        (
            ['record', '-a', '--snapshot-mode', '--max-cache-size', '0'],
            1,
            '--max-cache-size has to be above zero',
        ),
        (['record', '-a', '-f', 'json'], 2, "invalid choice: 'json'"),
        (['record', '-a', '--storage-config-file', '/nope'], 1, "'/nope' cannot be read"),
        (['play', '-i', 'x', 'rosbag_v2'], 1, 'rosbags-convert --src x'),
        (['play', 'x', '-i', 'y'], 1, 'Name all bags with -i, or a single one without'),
        (['play', 'x', '--clock', '--clock-topics-all'], 2, 'not allowed with argument --clock'),
        (['convert', '-o', 'x'], 1, 'Name the bags to read: with -i for each'),
        (['convert', '-i', 'a', '-o', '/nope'], 1, "'/nope' cannot be read"),
        (['info', ''], 1, 'The path of the bag is empty: name its folder'),
        (['info', '/etc/passwd'], 1, "'/etc/passwd' is not an MCAP file\n"),
        (['record', '-a', '-s', 'sqlite3'], 2, "invalid choice: 'sqlite3'"),
        (
            ['record', '-a', '--qos-profile-overrides-path', '/nope'],
            1,
            "'/nope' is not a file with",
        ),
        (['play'], 1, 'Name a bag: its folder, or several with -i'),
        (['play', 'x', '-r', '0'], 2, "'0' is not a number above zero"),
        (['play', 'x', '--remap', 'a=b'], 2, "'a=b' is not of the form OLD:=NEW"),
        (['play', 'x', '--clock', '-5'], 2, "'-5' is not a number above zero"),
        (['info'], 2, 'the following arguments are required: bag_path'),
        (['list', 'x'], 2, "invalid choice: 'x'"),
        (['nope'], 2, "invalid choice: 'nope'"),
    ],
)
def test_usage_errors(
    words: list[str], status: int, error: str, ros2_here: Ros2, tmp_path: Path
) -> None:
    """What cannot be meant is an error of a sentence, with the status that the frame has."""
    result = ros2_here('bag', *words)
    assert (result.returncode, error in result.stderr) == (status, True), result.stderr


def test_help_names_all_verbs(ros2_here: Ros2) -> None:
    """The command without a verb prints its help."""
    output = ros2_here('bag').stdout
    for verb in ('burst', 'convert', 'info', 'list', 'play', 'record', 'recover', 'reindex'):
        assert f'\n  {verb} ' in output


def test_human_size() -> None:
    """Sizes are printed in powers of 1024."""
    assert [human_size(size) for size in (0, 1023, 1024, 5 * 1024**2, 3 * 1024**4)] == [
        '0 B',
        '1023 B',
        '1.0 KiB',
        '5.0 MiB',
        '3.0 TiB',
    ]


def test_topic_filter() -> None:
    """Names, types and regular expressions choose; exclusions and hidden names are left out."""
    text = 'std_msgs/msg/String'
    everything = TopicFilter(everything=True, include_hidden=False)
    assert everything.wants('/a', text)
    assert not everything.wants('/_a', text)
    assert TopicFilter(topics=frozenset({'/_a'}), include_hidden=False).wants('/_a', 'x')
    assert TopicFilter(types=frozenset({text})).wants('/b', text)
    assert TopicFilter(regex=re.compile('joint.*s$')).wants('/robot/joint_states', 'x')
    assert not TopicFilter(regex=re.compile('joint')).wants('/tf', 'x')
    excluding = TopicFilter(
        everything=True,
        excluded_regex=re.compile('image'),
        excluded_topics=frozenset({'/b'}),
        excluded_types=frozenset({'t'}),
    )
    wanted = [excluding.wants(*each) for each in (('/image', 'x'), ('/b', 'x'), ('/c', 't'))]
    assert wanted == [False, False, False]
    assert excluding.wants('/c', 'x')


def test_filter_of_services() -> None:
    """The events of a service are chosen as the service, apart from topics."""
    events = ('/left/add/_service_event', 'example_interfaces/srv/AddTwoInts_Event')
    assert not TopicFilter(everything=True).wants(*events)
    assert TopicFilter(all_services=True, include_hidden=False).wants(*events)
    assert not TopicFilter(all_services=True).wants('/left/add', 'std_msgs/msg/String')
    assert TopicFilter(services=frozenset({'/left/add'})).wants(*events)
    assert TopicFilter(topics=frozenset({events[0]})).wants(*events)
    assert TopicFilter(regex=re.compile('left.*add$')).wants(*events)
    excluding = TopicFilter(all_services=True, excluded_services=frozenset({'/left/add'}))
    assert not excluding.wants(*events)
    assert not TopicFilter(all_services=True, excluded_regex=re.compile('^/left')).wants(*events)
    assert TopicFilter(services=frozenset({'/a'})).named == {'/a/_service_event'}

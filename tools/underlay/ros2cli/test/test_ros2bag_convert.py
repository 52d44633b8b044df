# SPDX-License-Identifier: Apache-2.0
"""Tests of `ros2 bag convert`: what is written of which bags, and what is refused."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from subprocess import CompletedProcess

from bag_samples import MS, start_bag, START_NS, string, texts, topic, write_bag
from mcap.reader import make_reader
import pytest
from ros2bag.api.storage_config import read_storage_config
from ros2bag.storage import BagError
from ros2bag.storage.bag_reader import BagReader
from ros2bag.storage.bag_writer import BagWriter, WriterOptions
from ros2bag.storage.definitions import Definition
from ros2bag.storage.metadata import Topic

Ros2 = Callable[..., CompletedProcess[str]]


def _outputs(tmp_path: Path, *entries: str) -> str:
    path = tmp_path / 'out.yaml'
    bags = ''.join(f'- {{uri: {tmp_path}/{entry}}}\n' for entry in entries)
    path.write_text(f'output_bags:\n{bags}')
    return str(path)


def test_merge(ros2_here: Ros2, tmp_path: Path) -> None:
    """Messages of all bags are in the new one, in the order of their times."""
    for name, offset in (('a', 0), ('b', 5)):
        writer = start_bag(tmp_path / name, topic(f'/{name}'))
        for number in range(3):
            writer.write(string(f'/{name}', f'{number}', (10 * number + offset) * MS))
        writer.close()
    out = _outputs(tmp_path, 'new, storage_id: "", all_topics: true, all_services: true')
    words = ['-i', f'{tmp_path}/a', '-i', f'{tmp_path}/b', 'mcap', '-o', out]
    result = ros2_here('bag', 'convert', *words)
    assert (result.returncode, result.stderr) == (0, '')
    assert result.stdout == f'{tmp_path}/new: 6 messages\n'
    messages = list(BagReader(str(tmp_path / 'new')).messages())
    assert [each.topic for each in messages] == ['/a', '/b'] * 3
    assert [each.log_ns - START_NS for each in messages] == [5 * MS * n for n in range(6)]


def test_split_filter_and_cut(ros2_here: Ros2, tmp_path: Path) -> None:
    """Each output has its topics, its time span, its files and its compression."""
    write_bag(tmp_path / 'bag', count=100)
    end = START_NS + 290 * MS
    out = _outputs(
        tmp_path,
        f'ticks, topics: [ticks], start_time_ns: {START_NS + 200 * MS}, end_time_ns: {end}',
        'robot, regex: descr',
        'none',
        'parts, all: true, exclude_topics: [/description], max_bagfile_duration: 0.3, '
        'compression_mode: file, compression_format: zstd, custom_data: {place: 7}',
    )
    inputs = tmp_path / 'in.yaml'
    inputs.write_text(f'input_bags: [{{uri: {tmp_path}/bag, storage_id: mcap}}]')
    result = ros2_here('bag', 'convert', '--input-options', str(inputs), '-o', out)
    assert (result.returncode, result.stderr) == (0, '')
    found = {name: BagReader(str(tmp_path / name)) for name in ('ticks', 'robot', 'none', 'parts')}
    assert texts(found['ticks'].messages(), '/ticks') == [str(n) for n in range(20, 30)]
    assert texts(found['robot'].messages(), '/description') == ['<robot/>']
    assert not list(found['none'].messages()) and not found['none'].metadata.topics
    assert len(found['parts'].metadata.files) == 4
    assert found['parts'].metadata.custom_data == {'place': '7'}
    assert texts(found['parts'].messages(), '/ticks') == [str(n) for n in range(100)]
    with (tmp_path / 'parts' / 'parts_0.mcap').open('rb') as stream:
        summary = make_reader(stream).get_summary()
    assert summary is not None
    assert {each.compression for each in summary.chunk_indexes} == {'zstd'}


def test_definitions_are_kept(ros2_here: Ros2, tmp_path: Path) -> None:
    """A type that is not installed here keeps the definition that was recorded."""
    kind = Topic('/far', 'far_msgs/msg/Far')
    recorded = Definition('ros2msg', 'int8 far')
    writer = BagWriter(str(tmp_path / 'bag'), WriterOptions(), lambda name: recorded)
    writer.set_topic(kind)
    writer.write(string('/far', 'x', 0))
    writer.close()
    out = _outputs(tmp_path, 'new, all_topics: true')
    assert ros2_here('bag', 'convert', '-i', f'{tmp_path}/bag', '-o', out).returncode == 0
    reader = BagReader(str(tmp_path / 'new'))
    assert reader.definitions() == {'far_msgs/msg/Far': recorded}


@pytest.mark.parametrize(
    ('entry', 'reason'),
    [
        ('x, all_topic: true', "there is no option 'all_topic'. Did you mean 'all_topics'?"),
        ('x, topics: /a', "topics cannot be '/a'"),
        ('x, storage_id: sqlite3', "storage_id cannot be 'sqlite3', only mcap"),
        ('x, compression_mode: file', 'compression_mode needs a compression_format as well'),
        ('x, regex: (', "'(' is not a regular expression"),
        ('x, max_bagfile_size: big', "max_bagfile_size cannot be 'big'"),
        ('bag', "Output folder '{}/bag' already exists"),
    ],
)
def test_mistakes_are_sentences(ros2_here: Ros2, tmp_path: Path, entry: str, reason: str) -> None:
    """What the file may not have is named, and nothing is written."""
    write_bag(tmp_path / 'bag')
    out = _outputs(tmp_path, entry)
    result = ros2_here('bag', 'convert', '-i', f'{tmp_path}/bag', '-o', out)
    assert (result.returncode, result.stdout) == (1, '')
    assert reason.format(tmp_path) in result.stderr
    assert not (tmp_path / 'x').exists()


@pytest.mark.parametrize('text', ['', 'output_bags: []', '- a', 'output_bags: [{storage_id: ""}]'])
def test_malformed_files(ros2_here: Ros2, tmp_path: Path, text: str) -> None:
    """A file without a list of bags, or a bag without a folder, is an error with an example."""
    path = tmp_path / 'out.yaml'
    path.write_text(text)
    write_bag(tmp_path / 'bag')
    result = ros2_here('bag', 'convert', '-i', f'{tmp_path}/bag', '-o', str(path))
    assert result.returncode == 1 and 'uri' in result.stderr and 'Trace' not in result.stderr


@pytest.mark.parametrize(
    ('text', 'found'),
    [
        ('', {}),
        ('compression: Zstd\nchunkSize: 4096', {'compression': 'zstd', 'chunk_bytes': 4096}),
        ('compression: None\nnoChunkCRC: false\nforceCompression: true', {'compression': 'none'}),
    ],
)
def test_storage_configuration(tmp_path: Path, text: str, found: object) -> None:
    """The settings of the MCAP writer that make a difference here."""
    path = tmp_path / 'config.yaml'
    path.write_text(text)
    assert read_storage_config(str(path)) == found


@pytest.mark.parametrize(
    ('text', 'reason'),
    [
        ('noChunking: true', 'noChunking can only be false'),
        ('compressionLevel: Slow', 'compressionLevel can only be Default'),
        ('chunksize: 1', "no setting 'chunksize'. Did you mean 'chunkSize'?"),
        ('compression: Gzip', "no compression 'Gzip'"),
        ('chunkSize: 0', 'chunkSize has to be a number of bytes'),
        ('- 1', 'is not a storage configuration'),
    ],
)
def test_storage_configuration_that_is_not_possible(
    tmp_path: Path, text: str, reason: str
) -> None:
    """A setting that would be ignored is refused."""
    path = tmp_path / 'config.yaml'
    path.write_text(text)
    with pytest.raises(BagError, match=reason.replace('?', r'\?')):
        read_storage_config(str(path))

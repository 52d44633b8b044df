# SPDX-License-Identifier: Apache-2.0
"""Tests of what is saved of recordings that were not finished, or are damaged."""

from collections.abc import Callable
from pathlib import Path
import re
import struct
from subprocess import CompletedProcess
import zlib

from bag_damage import COUNT, damage_everywhere, unfinished_bag
from bag_samples import MS, start_bag, string, texts, topic, write_bag
from mcap.reader import NonSeekingReader
import pytest
from ros2bag.storage import BagError
from ros2bag.storage.bag_reader import BagReader
from ros2bag.storage.bag_writer import Reserve
from ros2bag.storage.damage import BrokenFile
from ros2bag.storage.definitions import Definition
from ros2bag.storage.mcap_file import McapFile
from ros2bag.storage.recovery import recover, write_metadata
from rosbags.highlevel import AnyReader

Ros2 = Callable[..., CompletedProcess[str]]

WHOLE_MESSAGE = re.compile(rb'\x00\x01\x00\x00[\x02\x03]\x00\x00\x00\d+\x00')


def test_killed_recording_is_saved_whole(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """All chunks that were written are there afterwards, for all readers."""
    path = unfinished_bag(tmp_path / 'bag', monkeypatch)
    before = path.read_bytes()
    with pytest.raises(BagError, match=r'no metadata.yaml: .* ros2 bag recover'):
        BagReader(str(tmp_path / 'bag'))
    with pytest.raises(BrokenFile, match='was not finished'):
        BagReader(str(path))
    (outcome,) = recover(str(tmp_path / 'bag'))
    assert (outcome.was_broken, outcome.message_count) == (True, COUNT)
    reader = BagReader(str(tmp_path / 'bag'))
    assert texts(reader.messages(), '/ticks') == [str(number) for number in range(COUNT)]
    with AnyReader([tmp_path / 'bag']) as other:
        assert other.message_count == COUNT
    names = {each.name for each in (tmp_path / 'bag').iterdir()}
    assert names == {'bag_0.mcap', 'bag_0.mcap.broken', 'metadata.yaml'}
    assert (tmp_path / 'bag' / 'bag_0.mcap.broken').read_bytes() == before


@pytest.mark.parametrize('share', [0.05, 0.4, 0.55, 0.73, 0.9, 0.999])
def test_truncated_file_keeps_its_beginning(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, share: float
) -> None:
    """Wherever the file is cut off, the messages before that are saved, without a gap."""
    path = unfinished_bag(tmp_path / 'bag', monkeypatch)
    content = path.read_bytes()
    path.write_bytes(content[: int(len(content) * share)])
    recover(str(tmp_path / 'bag'))
    saved = texts(BagReader(str(tmp_path / 'bag')).messages(), '/ticks')
    assert saved == [str(number) for number in range(len(saved))]
    assert len(saved) == len(WHOLE_MESSAGE.findall(content[: int(len(content) * share)]))


def test_chunk_that_is_cut_off_keeps_whole_messages(tmp_path: Path) -> None:
    """Of an uncompressed chunk that was half written, the messages before the break are saved."""
    write_bag(tmp_path / 'bag', count=100)
    path = tmp_path / 'bag' / 'bag_0.mcap'
    content = path.read_bytes()
    path.write_bytes(content[: content.index(b'\x03\x00\x00\x0050\x00')])
    recover(str(tmp_path / 'bag'))
    saved = texts(BagReader(str(tmp_path / 'bag')).messages(), '/ticks')
    assert saved == [str(number) for number in range(50)]


def test_damaged_chunk_is_left_out(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """One flipped byte costs its chunk, and what follows is saved."""
    path = unfinished_bag(tmp_path / 'bag', monkeypatch)
    content = bytearray(path.read_bytes())
    content[content.index(b'\x03\x00\x00\x0021\x00') + 4] ^= 0xFF
    path.write_bytes(content)
    (outcome,) = recover(str(tmp_path / 'bag'))
    assert (outcome.message_count, outcome.damaged_parts) == (COUNT - 4, 1)
    saved = texts(BagReader(str(tmp_path / 'bag')).messages(), '/ticks')
    assert saved == [str(number) for number in range(COUNT) if number not in range(20, 24)]


@pytest.mark.parametrize('size', [1, 20])
@pytest.mark.parametrize('compression', ['none', 'zstd'])
def test_damage_anywhere_costs_one_chunk_at_most(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, size: int, compression: str
) -> None:
    """Whatever byte is damaged, reading tells it or is right, and recover saves the rest."""
    damage_everywhere(tmp_path / 'bag', monkeypatch, size, compression, step=4 * 97)  # story: 97


@pytest.mark.parametrize('size', [0, 5, 8, 20])
def test_file_that_was_hardly_begun_does_not_stop_the_others(tmp_path: Path, size: int) -> None:
    """A recorder that is killed while it starts a file leaves a few bytes: no messages."""
    write_bag(tmp_path / 'bag', max_duration_ns=100 * MS)
    (tmp_path / 'bag' / 'bag_0.mcap').rename(tmp_path / 'bag' / 'bag_2.mcap')
    path = tmp_path / 'bag' / 'bag_3.mcap'
    path.write_bytes((tmp_path / 'bag' / 'bag_1.mcap').read_bytes()[:size])
    counts = [each.message_count for each in recover(str(tmp_path / 'bag'))]
    assert counts == [11, 11, 0]
    with AnyReader([tmp_path / 'bag']) as other:
        assert other.message_count == 22


def test_what_was_broken_is_never_overwritten(tmp_path: Path) -> None:
    """When a file breaks again, what it was then is kept beside what it was before."""
    write_bag(tmp_path / 'bag')
    path = tmp_path / 'bag' / 'bag_0.mcap'
    for _ in range(2):
        path.write_bytes(path.read_bytes()[:-30])
        recover(str(tmp_path / 'bag'))
    names = {each.name for each in (tmp_path / 'bag').glob('*.broken*')}
    assert names == {'bag_0.mcap.broken', 'bag_0.mcap.broken2'}


def test_check_sum_of_the_data_is_right(tmp_path: Path) -> None:
    """The reader of `mcap` that checks all sums finds none that is wrong."""
    write_bag(tmp_path / 'bag')
    with (tmp_path / 'bag' / 'bag_0.mcap').open('rb') as stream:
        found = list(NonSeekingReader(stream, validate_crcs=True).iter_messages())
    assert len(found) == 21
    content = (tmp_path / 'bag' / 'bag_0.mcap').read_bytes()
    end = content.rindex(b'\x0f\x04\x00\x00\x00\x00\x00\x00\x00')
    (written,) = struct.unpack_from('<I', content, end + 9)
    assert written == zlib.crc32(content[:end])


def test_tail_of_zeros_ends_the_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A disk that lost its power leaves zeros, which are no messages."""
    path = unfinished_bag(tmp_path / 'bag', monkeypatch)
    path.write_bytes(path.read_bytes() + bytes(5000))
    (outcome,) = recover(str(tmp_path / 'bag'))
    assert outcome.message_count == COUNT


def test_compressed_files_stay_compressed(tmp_path: Path) -> None:
    """The saved file is compressed like the broken one, and the index is made anew."""
    write_bag(tmp_path / 'bag', count=200, compression='zstd')
    path = tmp_path / 'bag' / 'bag_0.mcap'
    path.write_bytes(path.read_bytes()[:-30])
    (outcome,) = recover(str(tmp_path / 'bag'))
    assert outcome.message_count == 201
    assert b'zstd' in path.read_bytes()


def test_only_broken_files_are_rewritten(tmp_path: Path) -> None:
    """Whole files of a recording stay as they are; the order is that of the numbers."""
    write_bag(tmp_path / 'bag', count=120, max_duration_ns=100 * MS)
    (tmp_path / 'bag' / 'metadata.yaml').unlink()
    last = tmp_path / 'bag' / 'bag_11.mcap'
    last.write_bytes(last.read_bytes()[:-30])
    outcomes = recover(str(tmp_path / 'bag'))
    assert [each.was_broken for each in outcomes] == [False] * 11 + [True]
    reader = BagReader(str(tmp_path / 'bag'))
    assert [file.path for file in reader.metadata.files][1:3] == ['bag_1.mcap', 'bag_2.mcap']
    numbers = texts(reader.messages(), '/ticks')
    assert numbers == [str(number) for number in range(120)]


def test_reindex_equals_what_the_recorder_wrote(tmp_path: Path) -> None:
    """The metadata can be made from the files alone."""
    write_bag(tmp_path / 'bag', max_duration_ns=50 * MS)
    path = tmp_path / 'bag' / 'metadata.yaml'
    before = path.read_text()
    path.unlink()
    assert write_metadata(str(tmp_path / 'bag')) == 24
    assert path.read_text() == before


def test_reindex_keeps_what_only_the_metadata_has(tmp_path: Path) -> None:
    """What the user has added to it is in none of the files."""
    write_bag(tmp_path / 'bag', custom_data={'place': 'kitchen'})
    write_metadata(str(tmp_path / 'bag'))
    assert BagReader(str(tmp_path / 'bag')).metadata.custom_data == {'place': 'kitchen'}


def test_metadata_that_is_no_text_is_a_sentence(tmp_path: Path) -> None:
    """And is made anew."""
    write_bag(tmp_path / 'bag')
    (tmp_path / 'bag' / 'metadata.yaml').write_bytes(b'\xff\xfe')
    with pytest.raises(BagError, match='cannot be read'):
        BagReader(str(tmp_path / 'bag'))
    write_metadata(str(tmp_path / 'bag'))
    assert BagReader(str(tmp_path / 'bag')).metadata.span.message_count == 21


def test_running_recording_is_left_alone(tmp_path: Path) -> None:
    """What is still being written is not touched."""
    writer = start_bag(tmp_path / 'bag', topic('/ticks'))
    with pytest.raises(BagError, match='is still being recorded'):
        recover(str(tmp_path / 'bag'))
    writer.close()


@pytest.mark.parametrize(
    ('name', 'error'),
    [('', 'has no .mcap file'), ('x.mcap', 'is not an MCAP file'), ('y', 'has no .mcap file')],
)
def test_what_is_no_recording_is_refused(tmp_path: Path, name: str, error: str) -> None:
    """A folder without files of a recording, or with something else, is a sentence."""
    if name:
        (tmp_path / name).write_text('this is no recording at all, but a text of some length')
    with pytest.raises(BagError, match=error):
        recover(str(tmp_path))


def test_disk_that_gets_room_again_loses_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """When the disk is full, the reserve makes room for the end: all messages are there."""
    resource = pytest.importorskip('resource')
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    writer = start_bag(tmp_path / 'bag', topic('/ticks'))
    monkeypatch.setattr(
        Reserve, 'release', lambda _: resource.setrlimit(resource.RLIMIT_FSIZE, before)
    )
    resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, before[1]))
    count = 0
    try:
        with pytest.raises(
            BagError, match=r'cannot be written: .* messages are complete'
        ) as error:
            for count in range(1000):
                writer.write(string('/ticks', f'{count} {"x" * 1000}', count * MS))
                monkeypatch.setattr('ros2bag.storage.mcap_file.CHUNK_TIME_S', 0.0)
                writer.flush_if_due()
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    assert f'its {count + 1} messages' in str(error.value)
    writer.close()
    reader = BagReader(str(tmp_path / 'bag'))
    reader.check()
    numbers = [text.split()[0] for text in texts(reader.messages(), '/ticks')]
    assert numbers == [str(number) for number in range(count + 1)]


def test_limit_on_the_size_of_files_leaves_a_recoverable_file(tmp_path: Path) -> None:
    """Without room for the index, what was written can be recovered; the error says how."""
    resource = pytest.importorskip('resource')
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    writer = start_bag(tmp_path / 'bag', topic('/ticks'))
    resource.setrlimit(resource.RLIMIT_FSIZE, (700_000, before[1]))
    try:
        with pytest.raises(BagError, match=r'ros2 bag recover .* with -b BYTES'):
            for number in range(2000):
                writer.write(string('/ticks', f'{number} {"x" * 1000}', number * MS))
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    (outcome,) = recover(str(tmp_path / 'bag'))
    assert outcome.message_count > 600


def test_chunks_are_written_in_time(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What waits longer than the limit is on the disk after the next look, and not before."""
    clock = [100.0]
    monkeypatch.setattr('ros2bag.storage.mcap_file.time.monotonic', lambda: clock[0])
    path = tmp_path / 'a.mcap'
    file = McapFile(str(path))
    file.add_topic(topic('/ticks'), Definition())
    file.write(*string('/ticks', 'needle', 0))
    for now_s, expected in ((100.05, 0), (100.11, 1), (100.5, 1)):
        clock[0] = now_s
        file.flush_if_due()
        assert path.read_bytes().count(b'needle') == expected
    file.close()


def test_recover_says_what_it_did(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, ros2_here: Ros2
) -> None:
    """The command names each file, what was saved and where the broken one is."""
    path = unfinished_bag(tmp_path / 'bag', monkeypatch)
    result = ros2_here('bag', 'recover', str(tmp_path / 'bag'))
    assert result.stdout.splitlines() == [
        f'{path}: recovered {COUNT} messages; the original is kept as {path}.broken, which '
        'can be deleted',
        f'{tmp_path / "bag"}: {COUNT} messages; metadata.yaml is written',
    ]
    assert (result.returncode, result.stderr) == (0, '')
    assert ros2_here('bag', 'reindex', str(tmp_path / 'bag')).returncode == 0

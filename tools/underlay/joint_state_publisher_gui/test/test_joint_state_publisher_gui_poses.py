# SPDX-License-Identifier: Apache-2.0
"""Poses that are kept in files."""

from __future__ import annotations

from pathlib import Path

from joint_state_publisher_gui.poses import pose_file, PoseError, Poses
import pytest


@pytest.fixture
def poses(tmp_path: Path) -> Poses:
    """Return poses in a folder that is not there yet."""
    return Poses(tmp_path / 'new/robot.yaml')


def test_saved_poses_are_read_again(poses: Poses) -> None:
    """Poses come back as they were, in the order of their saving, and no other file stays."""
    assert poses.read() == {}
    assert poses.save(' 1: é ', {'knee': 0.1 + 0.2}) == '1: é'
    poses.save('yes', {'knee': -1e-300})
    poses.save('yes', {})
    assert Poses(poses.file).read() == {'1: é': {'knee': 0.1 + 0.2}, 'yes': {}}
    assert poses.delete('1: é')
    assert not poses.delete('gone')
    assert list(poses.read()) == ['yes']
    assert list(poses.file.parent.iterdir()) == [poses.file]


@pytest.mark.parametrize(
    ('content', 'why'),
    [
        ('a: [', 'while parsing'),
        ('- a', 'it must map names to poses'),
        ('wave: 3', "the pose 'wave' must map joints to positions"),
        ('wave: {knee: bent}', "'bent' of 'knee' in the pose 'wave' is not a position"),
        ('wave: {knee: .nan}', "'nan' of 'knee'"),
        ('wave: {knee: true}', "'True' of 'knee'"),
        (f'wave: {{knee: {10**400}}}', "of 'knee' in the pose 'wave' is not a position"),
        ('[' * 5000, ''),
        ('\x00', 'special characters are not allowed'),
        (b'\xff\xfe\xfa', ''),
        ('#' * 4_000_001, 'it is larger than 4 MB'),
    ],
)
def test_broken_files_are_kept(poses: Poses, content, why) -> None:
    """A file that has no poses has a sentence, and is not written to."""
    data = content if isinstance(content, bytes) else content.encode()
    poses.file.parent.mkdir()
    poses.file.write_bytes(data)
    for use in (poses.read, lambda: poses.save('new', {}), lambda: poses.delete('new')):
        with pytest.raises(PoseError) as caught:
            use()
        assert f"'{poses.file}' cannot be used, and is left unchanged: " in str(caught.value)
        assert why in str(caught.value)
        assert poses.file.read_bytes() == data


@pytest.mark.parametrize('name', ['', '  ', 'x' * 61, 'a\nb'])
def test_names_must_be_readable(poses: Poses, name) -> None:
    """A pose needs a name of one line."""
    with pytest.raises(PoseError, match='The pose is not saved'):
        poses.save(name, {})
    assert not poses.file.exists()


def test_a_folder_that_cannot_be_made_has_a_sentence(tmp_path: Path) -> None:
    """A file in the place of the folder gives no traceback."""
    (tmp_path / 'file').write_text('')
    with pytest.raises(PoseError, match='cannot be'):
        Poses(tmp_path / 'file/robot.yaml').save('wave', {})


def test_each_robot_has_a_file_in_the_folder(tmp_path: Path) -> None:
    """A robot's name leads nowhere else, and no two have the same file."""
    names = ['humanoid', '../../evil', '/etc/passwd', '..', 'a/b', 'a_b', 'a%2Fb']
    files = {pose_file(name, tmp_path) for name in names}
    assert len(files) == len(names)
    assert all(file.parent == tmp_path and file.suffix == '.yaml' for file in files)
    assert pose_file('humanoid', tmp_path).name == 'humanoid.yaml'

# SPDX-License-Identifier: Apache-2.0
"""Tests of reading and writing .rviz files."""

import os
from pathlib import Path
import re
import stat
from typing import Any

import pytest
from rviz_common.config import ConfigError, Configuration
from rviz_common.config.configuration import DISPLAYS, OPTIONS
from rviz_common.config.yaml_file import read_yaml, replace_file, write_yaml
import yaml

DISPLAY = 'Visualization Manager:\n  Displays:\n    '


@pytest.mark.parametrize(
    ('text', 'sentence'),
    [
        ('Panels: ~\nPanels: ~\n', r"^f:2: 'Panels' is already in line 1"),
        ('Panels:\n\t- a\n', r'^f:2: There is a tab\. Indent with spaces'),
        ('Panels: 3\n', r"^f:1: 'Panels' must be a list .*, not '3'"),
        (f'{DISPLAY}- 3\n', r"^f:3: This must be a mapping .*, not '3'"),
        (f'{DISPLAY}- Name: a\n', r"^f:3: 'Class' is missing"),
        (f'{DISPLAY}- Class: [a]\n', r"^f:3: 'Class' must be a string, not a list"),
        (
            f'{DISPLAY}- Class: rviz_common/Group\n      Displays:\n        - x: 1\n',
            r"^f:5: 'Class' is missing",
        ),
        ('- 3\n', r'^f:1: This must be a mapping'),
        ('', r'^f: The file is empty'),
        ('a: [1, 2\n', r'^f:2: This is not YAML'),
        ("a: 'b\n", r'^f:\d: This is not YAML'),
        ('a: \x01\n', r'^f: This is not YAML'),
        ('a: 1\n---\nb: 1\n', r'^f:2: A second document'),
        ('a: &x [*x]\n', r"^f:1: Alias '\*x' is not supported"),
        ('? [a]\n: b\n', r'^f:1: A key must be a string'),
        ('Visualization Manager:\n  Global Options: 5\n', r"^f:2: 'Global Options' must be a map"),
        ('Visualization Manager:\n  Views: []\n', r"^f:2: 'Views' must be a mapping"),
    ],
)
def test_what_is_wrong_is_said_with_its_place(text: str, sentence: str) -> None:
    """A broken file gives one sentence, which begins with the file and the line."""
    with pytest.raises(ConfigError) as error:
        Configuration.parse(text, 'f')
    assert re.search(sentence, str(error.value)), str(error.value)


@pytest.mark.parametrize(
    'text',
    ['[' * 10**6, '- ' * 10**5, ''.join(f'{" " * i}a:\n' for i in range(500))],
    ids=['brackets', 'dashes', 'names'],
)
def test_deep_files_are_refused(text: str) -> None:
    """However deep a file is, reading it ends with a sentence."""
    with pytest.raises(ConfigError, match=r'The file is nested too deeply') as error:
        Configuration.parse(text, 'f')
    assert len(str(error.value)) < 100


@pytest.mark.parametrize(
    ('text', 'value'),
    [
        ('0.5', 0.5),
        ('-3', -3),
        ('1e-05', 1e-05),
        ('true', True),
        ('False', False),
        ('~', None),
        ('', None),
        ('"5"', '5'),
        ('007', '007'),
        ('on', 'on'),
        ('1:30', '1:30'),
        ('0x12', '0x12'),
        ('1_000', '1_000'),
        ('nan', 'nan'),
        ('.inf', '.inf'),
        ('1e400', '1e400'),
        ('2001-01-01', '2001-01-01'),
        ('255; 0; 0', '255; 0; 0'),
    ],
)
def test_scalars_are_what_rviz_takes_them_for(text: str, value: Any) -> None:
    """Only what is written back the same is taken for a number."""
    found = read_yaml(f'a: {text}', 'f').values['a']
    assert found == value and type(found) is type(value)
    assert read_yaml(write_yaml({'a': value}), 'f').values == {'a': value}


@pytest.mark.parametrize('text', ['', '5', 'true', '~', '#a', 'a: b', 'a\nb', '- a', 'ü', ' a '])
def test_texts_are_written_so_that_they_remain_texts(text: str) -> None:
    """Whatever a text has, it is read back as it was; other readers read it, too."""
    written = write_yaml({text: text, 'list': [text, [text]]})
    assert read_yaml(written, 'f').values == {text: text, 'list': [text, [text]]}
    assert yaml.safe_load(written)['list'][0] == text


def test_files_of_rviz_are_written_back_equal(file: Path) -> None:
    """A file that nobody has changed keeps all values, and their order."""
    configuration = Configuration.read(str(file))
    again = Configuration.parse(configuration.text({}), 'again')
    assert again.document.values == configuration.document.values
    assert configuration.text({}) == again.text({})
    changed = set(configuration.text({}).splitlines()) ^ set(file.read_text().splitlines())
    assert changed <= {'      Namespaces:', '        {}', '      Namespaces: {}', ''}


def test_only_sections_that_have_changed_are_written_anew() -> None:
    """A section is written at its place; a file does not get sections for nothing."""
    configuration = Configuration.parse('X: 1\nPanels: ~\nY: 2\n', 'f')
    same = {DISPLAYS: configuration.displays, OPTIONS: configuration.options}
    assert configuration.text(same) == 'X: 1\nPanels: ~\nY: 2\n'
    text = configuration.text({**same, OPTIONS: {'Fixed Frame': 'odom'}})
    assert text.endswith(
        'Y: 2\nVisualization Manager:\n  Global Options:\n    Fixed Frame: odom\n'
    )


def test_the_default_configuration_is_one() -> None:
    """What is shown without a file can be saved, and read."""
    configuration = Configuration.default()
    again = Configuration.parse(configuration.text({}), 'f')
    assert again.document.values == configuration.document.values
    assert [each['Class'] for each in again.displays] == ['rviz_default_plugins/Grid']


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    """The sentence has the full path."""
    with pytest.raises(ConfigError, match=r'a\.rviz: File not found\. Looked for /'):
        Configuration.read(str(tmp_path / 'a.rviz'))
    with pytest.raises(ConfigError, match='cannot be read: Is a directory'):
        Configuration.read(str(tmp_path))
    (tmp_path / 'b.rviz').write_bytes(b'\xff\xfe\x00')
    with pytest.raises(ConfigError, match='not a text file'):
        Configuration.read(str(tmp_path / 'b.rviz'))


def test_a_full_disk_loses_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where the new file cannot be written, the old one remains, and nothing besides."""

    def fail(descriptor: int) -> None:
        raise OSError(28, 'No space left on device')

    path = tmp_path / 'a.rviz'
    path.write_text('old')
    monkeypatch.setattr(os, 'fsync', fail)
    with pytest.raises(ConfigError, match=r'cannot be written: No space left.*It is unchanged'):
        replace_file(str(path), 'new')
    assert path.read_text() == 'old'
    assert list(tmp_path.iterdir()) == [path]


def test_saving_keeps_permissions_and_links(tmp_path: Path) -> None:
    """The file behind a link is replaced, and may be read by whom it could be read."""
    path, link = tmp_path / 'a.rviz', tmp_path / 'link.rviz'
    path.write_text('old')
    path.chmod(0o640)
    link.symlink_to(path)
    replace_file(str(link), 'new')
    assert link.is_symlink() and path.read_text() == 'new'
    assert stat.S_IMODE(path.stat().st_mode) == 0o640


def test_what_never_ends_is_not_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A pipe is not waited for, and a file that is too large is not read."""
    os.mkfifo(tmp_path / 'pipe.rviz')
    for path in (str(tmp_path / 'pipe.rviz'), '/dev/zero'):
        with pytest.raises(ConfigError, match='This is not a regular file'):
            Configuration.read(path)
    (tmp_path / 'large.rviz').touch()
    os.truncate(tmp_path / 'large.rviz', 10_000_001)
    with pytest.raises(ConfigError, match='larger than 10 MB'):
        Configuration.read(str(tmp_path / 'large.rviz'))

# SPDX-License-Identifier: Apache-2.0
"""Tests of the verbs that look at installed packages."""

from collections.abc import Callable
from pathlib import Path

import pytest
from ros2cli.cli import main

MANIFEST = '<package format="3"><name>arm</name><depend>rclpy</depend><depend>b</depend></package>'
Run = Callable[..., tuple[int, str, str]]


@pytest.fixture(autouse=True)
def prefix(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Make a prefix with two packages the only one of the environment."""
    index = tmp_path / 'share' / 'ament_index' / 'resource_index' / 'packages'
    index.mkdir(parents=True)
    for name in ('arm', 'bare'):
        (index / name).touch()
    share = tmp_path / 'share' / 'arm'
    share.mkdir()
    (share / 'package.xml').write_text(MANIFEST)
    lib = tmp_path / 'lib' / 'arm' / 'deep'
    lib.mkdir(parents=True)
    for path, mode in (
        (lib.parent / 'wave', 0o755),
        (lib / 'bend', 0o755),
        (lib.parent / 'data', 0o644),
    ):
        path.touch()
        path.chmod(mode)
    monkeypatch.setenv('AMENT_PREFIX_PATH', str(tmp_path))
    monkeypatch.delenv('COLCON_PREFIX_PATH', raising=False)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def run(capsys: pytest.CaptureFixture[str]) -> Run:
    """Return a function that runs `ros2 pkg` and returns status, output and errors."""

    def call(*words: str) -> tuple[int, str, str]:
        status = main(['pkg', *words])
        captured = capsys.readouterr()
        return status, captured.out, captured.err

    return call


def test_list_is_sorted(run: Run) -> None:
    """The list has one name a line."""
    assert run('list') == (0, 'arm\nbare\n', '')


def test_prefix_and_share(run: Run, prefix: Path) -> None:
    """The prefix and the share folder are printed."""
    assert run('prefix', 'arm') == (0, f'{prefix}\n', '')
    assert run('prefix', 'arm', '--share') == (0, f'{prefix}/share/arm\n', '')


@pytest.mark.parametrize(
    ('words', 'error'),
    [
        (['prefix', 'arn'], 'Package not found'),
        (['prefix', 'arn', '--share'], 'Package not found'),
        (['prefix', 'no/name'], 'Package not found'),
        (['prefix', ''], 'Package not found'),
        (['xml', 'arn'], 'Package not found'),
        (['executables', 'arn'], "Package 'arn' not found"),
    ],
)
def test_unknown_package(words: list[str], error: str, run: Run) -> None:
    """An unknown package has a short error and more to read below it."""
    status, output, errors = run(*words)
    assert (status, output) == (1, '')
    first, *advice = errors.splitlines()
    assert first == error
    assert advice
    assert all('Traceback' not in line for line in advice)


def test_unknown_package_suggests(run: Run) -> None:
    """A misspelt package is answered with the closest one."""
    assert "Did you mean 'bare'?" in run('executables', 'bar')[2]


def test_executables(run: Run, prefix: Path) -> None:
    """Executables in subfolders count, files that cannot be executed do not."""
    assert run('executables', 'arm') == (0, 'arm bend\narm wave\n', '')
    paths = f'{prefix}/lib/arm/deep/bend\n{prefix}/lib/arm/wave\n'
    assert run('executables', '--full-path') == (0, paths, '')
    assert run('executables', 'bare') == (0, '', '')


def test_xml(run: Run) -> None:
    """The manifest is printed as a whole, or the texts of one tag."""
    assert run('xml', 'arm') == (0, f'{MANIFEST}\n', '')
    assert run('xml', 'arm', '-t', 'depend') == (0, 'rclpy\nb\n', '')


def test_xml_errors(run: Run) -> None:
    """A missing tag and a missing manifest are errors."""
    assert run('xml', 'arm', '--tag', 'nope') == (1, '', 'XML tag not found\n')
    assert run('xml', 'arm', '--tag', '//[') == (1, '', 'XML tag not found\n')
    assert run('xml', 'bare') == (1, '', 'Package XML manifest not found\n')


def test_broken_manifest_is_a_sentence(run: Run, prefix: Path) -> None:
    """A manifest that cannot be parsed is named, with the place of the mistake."""
    manifest = prefix / 'share' / 'arm' / 'package.xml'
    manifest.write_text('<package>')
    assert run('xml', 'arm') == (
        1,
        '',
        f"'{manifest}' is not valid XML: no element found: line 1, column 9\n",
    )

# SPDX-License-Identifier: Apache-2.0
"""The log."""

from __future__ import annotations

from collections.abc import Callable
import logging
import os
from pathlib import Path
import re
import sys
from typing import Any

from launch._supervision.process_output import LineFormat, ProcessOutput
from launch.actions import LogInfo
from launch.logging import base_directory, get_logger, launch_config, reset
from launch.logging._output import normalize_output_config
import pytest

Run = Callable[..., Any]


@pytest.mark.parametrize(
    'variables, folder',
    [
        ({'ROS_LOG_DIR': '/a/b'}, '/a/b'),
        ({'ROS_LOG_DIR': '', 'ROS_HOME': '/a'}, '/a/log'),
        ({'ROS_LOG_DIR': '~/b', 'HOME': '/h'}, '/h/b'),
        ({'ROS_LOG_DIR': '', 'ROS_HOME': '', 'HOME': '/h'}, '/h/.ros/log'),
    ],
)
def test_base_directory(variables: Any, folder: str) -> None:
    """Environment variables say where the log files are; those that are empty do not count."""
    os.environ.update(variables)
    assert base_directory() == folder


def test_run_directory(run: Run, tmp_path: Path) -> None:
    """Each run has a folder with its log; a link leads to the latest one."""
    run(LogInfo(msg='first'))
    reset()
    run(LogInfo(msg='second'))
    latest = tmp_path / 'log' / 'latest'
    assert len(list((tmp_path / 'log').iterdir())) == 3
    assert os.readlink(latest) == launch_config.log_dir
    assert re.fullmatch(
        rf'[-0-9]{{26}}-{os.uname().nodename}-{os.getpid()}', latest.resolve().name
    )
    last = (latest / 'launch.log').read_text().splitlines()[-1]
    assert re.fullmatch(r'\d+\.\d{7} \[INFO\] \[launch.user\]: second', last)


def test_latest_that_is_no_link(run: Run, tmp_path: Path) -> None:
    """Something else of that name is left alone."""
    (tmp_path / 'log' / 'latest').mkdir(parents=True)
    assert 'is not a symbolic link and is left as it is' in run(LogInfo(msg='x')).text
    assert not (tmp_path / 'log' / 'latest').is_symlink()


def test_folder_that_cannot_be_made(tmp_path: Path) -> None:
    """The error tells which variable to set."""
    (tmp_path / 'file').touch()
    os.environ['ROS_LOG_DIR'] = str(tmp_path / 'file' / 'log')
    with pytest.raises(RuntimeError, match='set ROS_LOG_DIR to a folder'):
        _ = launch_config.log_dir


@pytest.mark.parametrize(
    'text, line',
    [
        ('default', r'\[INFO\] \[x\]: hi'),
        ('default_with_timestamp', r'\d+\.\d{7} \[INFO\] \[x\]: hi'),
        (r'{name}\t{message}', 'x\thi'),
        ('\u00e9\u20ac\\t{message}', '\u00e9\u20ac\thi'),
    ],
)
def test_screen_format(capfd: pytest.CaptureFixture[str], text: str, line: str) -> None:
    """The format of the screen can be set, with the names of some formats."""
    launch_config.set_screen_format(text)
    get_logger('x').info('hi')
    assert re.fullmatch(line + '\n', capfd.readouterr().out)


def test_log_format_from_the_environment(tmp_path: Path) -> None:
    """The format of the log file can be set by a variable."""
    os.environ['OVERRIDE_LAUNCH_LOG_FORMAT'] = '{levelname}|{message}'
    reset()
    get_logger('x').warning('hi')
    assert (tmp_path / 'log' / 'latest' / 'launch.log').read_text() == 'WARNING|hi\n'


def test_level(capfd: pytest.CaptureFixture[str]) -> None:
    """The level counts for loggers that exist already."""
    logger = get_logger('x')
    logger.debug('before')
    launch_config.level = logging.DEBUG
    logger.debug('after')
    assert capfd.readouterr().out == '[DEBUG] [x]: after\n'


def test_text_that_the_screen_cannot_show(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """What the encoding of the screen lacks is escaped."""
    with open(tmp_path / 'screen', 'w', encoding='ascii') as screen:
        monkeypatch.setattr(sys, 'stdout', screen)
        get_logger('x').info('\u20ac')
    assert (tmp_path / 'screen').read_text() == '[INFO] [x]: \\u20ac\n'


def test_log_file_that_cannot_be_written(capfd: pytest.CaptureFixture[str]) -> None:
    """A failure to write the file is reported once, and the screen goes on."""
    os.makedirs(os.path.join(launch_config.log_dir, 'launch.log'))
    for _ in range(2):
        get_logger('x').info('hi')
    out = capfd.readouterr().out
    assert out.count('can no longer be written') == 1 and out.count('[x]: hi') == 2
    assert "launch.log' first: Is a directory." in out


def test_full_disk_is_said_once(capfd: pytest.CaptureFixture[str]) -> None:
    """Nodes say each second that their log files cannot be written; a launch says it once."""
    error = (
        '[*** LOG ERROR #{} ***] [2026-11-22 08:37:28] [root] {{Failed writing to file '
        '/full/{}.log: No space left on device}}\n'
    )
    for name in ('walk', 'arm'):
        output = ProcessOutput(name, 'screen', LineFormat('{line}', None), keep=True)
        for number in range(3):
            output.feed(2, f'{error.format(number, name)}real {number}\n'.encode())
        assert output.kept(2).count('LOG ERROR') == 3
    out = capfd.readouterr().out
    assert out.count('No space left on device') == 1 and out.count('LOG ERROR') == 0
    assert "'/full/walk.log' first: No space left on device. Everything else continues" in out
    assert out.count('real ') == 6


def test_output_config() -> None:
    """The names of settings stand for destinations of each stream."""
    assert normalize_output_config('log') == {
        'stdout': frozenset(),
        'stderr': {'screen'},
        'both': {'log'},
    }
    assert normalize_output_config({'stdout': ('log', 'screen')})['stdout'] == {'log', 'screen'}

# SPDX-License-Identifier: Apache-2.0
"""Cases of section 3.11: the log."""

from __future__ import annotations

import re
from typing import Any

import pytest

HELLO = "LogInfo(msg='hello'), ExecuteProcess(cmd=['echo', 'text'], output='both'),"
TIME = r'\d{10}\.\d{7}'


@pytest.mark.parametrize(
    ('env', 'base'),
    [
        ({'ROS_LOG_DIR': 'HERE/own'}, 'own'),
        ({'ROS_LOG_DIR': '~/own', 'HOME': 'HERE'}, 'own'),
        ({'ROS_LOG_DIR': '', 'ROS_HOME': 'HERE/ros'}, 'ros/log'),
        ({'ROS_LOG_DIR': '', 'ROS_HOME': '', 'HOME': 'HERE/home'}, 'home/.ros/log'),
    ],
)
def test_folder(env: dict[str, str], base: str, launch: Any) -> None:
    """3.11 The folder of the log comes from ROS_LOG_DIR, else ROS_HOME, else the home."""
    env = {name: value.replace('HERE', str(launch.here)) for name, value in env.items()}
    out = launch("LogInfo(msg='hello'),", **env)
    folder = launch.here / base
    runs = sorted(path.name for path in folder.iterdir())
    assert len(runs) == 2
    name = r'\d{4}-\d\d-\d\d-\d\d-\d\d-\d\d-\d{6}-[\w.-]+-\d+'
    assert re.fullmatch(name, runs[0])
    assert runs[0].endswith(f'-{launch.started[-1].process.pid}')
    assert runs[1] == 'latest'
    assert (folder / 'latest').readlink() == folder / runs[0]
    assert [path.name for path in (folder / runs[0]).iterdir()] == ['launch.log']
    assert f'All log files can be found below {folder / runs[0]}' in out.stdout


def test_latest(launch: Any) -> None:
    """3.11 The link is replaced by each run; what is no link stays, with a warning."""
    launch("LogInfo(msg='one'),")
    first = (launch.here / 'log/latest').readlink()
    out = launch("LogInfo(msg='two'),")
    assert (launch.here / 'log/latest').readlink() != first
    assert 'two' in ''.join(out.log)
    (launch.here / 'other/latest').mkdir(parents=True)
    out = launch("LogInfo(msg='three'),", ROS_LOG_DIR=str(launch.here / 'other'))
    assert out.status == 0
    assert 'WARN' in out.stdout + out.err
    assert (launch.here / 'other/latest').is_dir()
    assert not (launch.here / 'other/latest').is_symlink()


def test_nodes_keep_the_base_folder(launch: Any) -> None:
    """3.11 Processes are not told about the folder of the run."""
    out = launch("ExecuteProcess(cmd=['rec']),")
    assert out.run.env['ROS_LOG_DIR'] == str(out.here / 'log')


def test_first_lines(launch: Any) -> None:
    """3.11 Each run begins with the folder and the level."""
    folder = r'HERE/log/[\w.-]+'
    for args, level in ([], 'INFO'), (['-d'], 'DEBUG'):
        out = launch("LogInfo(msg='hello'),", *args)
        first, second = out.tidy(out.stdout).splitlines()[:2]
        head = r'\[INFO\] \[launch\]: All log files can be found below '
        assert re.fullmatch(head + folder, first)
        assert second == f'[INFO] [launch]: Default logging verbosity is set to {level}'
        assert out.log[:2] == [first, second]


def test_formats(launch: Any) -> None:
    """3.11 Neither colour nor time on the screen; the time in front of each line in the file."""
    out = launch(HELLO)
    assert '[INFO] [launch.user]: hello' in out.lines
    assert '[echo-1] text' in out.lines
    assert '\x1b' not in out.stdout
    text = (out.here / 'log/latest/launch.log').read_text()
    assert re.search(rf'^{TIME} \[INFO\] \[launch.user\]: hello$', text, re.MULTILINE)
    assert re.search(rf'^{TIME} \[echo-1\] text$', text, re.MULTILINE)


def test_formats_of_ones_own(launch: Any) -> None:
    """3.11 Variables of the environment set the formats, in the style of braces."""
    out = launch(
        HELLO,
        OVERRIDE_LAUNCH_SCREEN_FORMAT=r'{levelname}\t{msg}',
        OVERRIDE_LAUNCH_LOG_FORMAT='<{name}> {msg}',
    )
    assert 'INFO\thello' in out.lines
    assert '<launch.user> hello' in out.log


@pytest.mark.parametrize(
    ('name', 'line'),
    [
        ('default', r'\[INFO\] \[launch.user\]: hello'),
        ('default_with_timestamp', rf'{TIME} \[INFO\] \[launch.user\]: hello'),
    ],
)
def test_named_formats(name: str, line: str, launch: Any) -> None:
    """3.11 Two formats for the screen have names."""
    out = launch("LogInfo(msg='hello'),", OVERRIDE_LAUNCH_SCREEN_FORMAT=name)
    assert any(re.fullmatch(line, each) for each in out.lines)


def test_loggers_of_a_launch_file(launch: Any) -> None:
    """3.11 A launch file may log, and read and change the settings."""
    out = launch(
        """
        import logging
        import os
        from launch.logging import get_logger, get_output_loggers, launch_config
        logger = get_logger('mine')
        ---
        OpaqueFunction(function=lambda context: logger.info('info')),
        OpaqueFunction(function=lambda context: logger.warning('warning')),
        OpaqueFunction(function=lambda context: logger.error('error')),
        OpaqueFunction(function=lambda context: logger.critical('critical')),
        OpaqueFunction(function=lambda context: logger.debug('never')),
        LogInfo(msg=str(os.path.isdir(launch_config.log_dir))),
        LogInfo(msg=logging.getLevelName(launch_config.level)),
        OpaqueFunction(function=lambda context: get_output_loggers('x', 'screen')[0].info('out')),
        OpaqueFunction(function=lambda context: launch_config.set_screen_format('! {msg}')),
        LogInfo(msg='last'),
        """
    )
    assert out.lines == [
        *[f'[{each.upper()}] [mine]: {each}' for each in ('info', 'warning', 'error', 'critical')],
        *['[INFO] [launch.user]: True', '[INFO] [launch.user]: INFO', 'out', '! last'],
    ]


def test_debug_level(launch: Any) -> None:
    """3.11 With -d, and only then, what is logged at DEBUG is written."""
    text = """
        from launch.logging import get_logger
        ---
        OpaqueFunction(function=lambda context: get_logger('mine').debug('detail')),
    """
    assert '[DEBUG] [mine]: detail' in launch(text, '-d').lines
    assert 'detail' not in launch(text).stdout
